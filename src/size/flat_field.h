// Whether a size field has sizes anywhere.
#pragma once

#include <algorithm>

#include "exact/predicates.h"
#include "holdfast/io.h"

namespace holdfast {

/// It has tetrahedra, and all of them are flat, exactly: then it has sizes nowhere.
[[nodiscard]] inline bool is_flat(const SizeField& field) {
  const auto is_flat_one = [&](const Tetrahedron& t) {
    const auto at = [&](std::size_t i) { return field.vertices[t[i]].data(); };
    return exact::orient3d(at(0), at(1), at(2), at(3)) == 0;
  };
  return !field.tetrahedra.empty() &&
         std::all_of(field.tetrahedra.begin(), field.tetrahedra.end(), is_flat_one);
}

}  // namespace holdfast
