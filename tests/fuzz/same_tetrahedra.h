// Tetrahedra after writing and reading.
#pragma once

#include <algorithm>
#include <vector>

#include "io/turn.h"

namespace holdfast::fuzz {

/// Whether the tetrahedra of a copy are those given. In VTK's formats the order of corners may say nothing
/// (io/turn.h), so that negative ones may come back reversed.
inline bool same_tetrahedra(const std::vector<Tetrahedron>& copy, const std::vector<Tetrahedron>& given,
                            const std::vector<Point>& vertices) {
  const auto is_same = [&](Tetrahedron a, Tetrahedron b) {
    if (a == b) return true;
    if (!io::is_turned(b, vertices) || io::is_turned(a, vertices)) return false;
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    return a == b;
  };
  return std::equal(copy.begin(), copy.end(), given.begin(), given.end(), is_same);
}

}  // namespace holdfast::fuzz
