// The edges of elements in the order of their mid-edge nodes (`MidNodes`), which is VTK's.
#pragma once

#include <array>
#include <cstddef>

#include "holdfast/types.h"

namespace holdfast {

inline constexpr std::array<std::array<std::size_t, 2>, 6> kTetrahedronEdges{
    {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
inline constexpr std::array<std::array<std::size_t, 2>, 3> kFacetEdges{{{0, 1}, {1, 2}, {0, 2}}};
inline constexpr std::array<std::array<std::size_t, 2>, 1> kSegmentEdges{{{0, 1}}};

/// Rounded once: halving is exact except for denormal numbers.
[[nodiscard]] inline Point middle(const Point& a, const Point& b) {
  return {0.5 * a[0] + 0.5 * b[0], 0.5 * a[1] + 0.5 * b[1], 0.5 * a[2] + 0.5 * b[2]};
}

}  // namespace holdfast
