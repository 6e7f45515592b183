// Frees the memory of containers before their scope ends.
#pragma once

namespace holdfast {

/// Empties a vector and frees its memory. `v = {}` would only empty it: it assigns an empty list.
template <class Vector>
void release(Vector& v) {
  Vector().swap(v);
}

}  // namespace holdfast
