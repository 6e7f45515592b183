// A triangulation of a closed walk in space that need not be plane.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "holdfast/types.h"
#include "plane/triangles.h"

namespace holdfast::plane {

/// Longer walks have no triangulation here: it takes time cubic in the number of corners.
inline constexpr std::size_t kMostCornersOfLeastArea = 600;

/// The triangulation of a walk with the fewest flat triangles and, of these, the least area (Klincsek 1980;
/// Barequet and Sharir 1995), oriented as the walk. Triangles are numbers of corners. One with two corners at
/// the same place is left out: its other two sides are one, which its neighbours share. Empty if areas are
/// not finite, or the walk has too many corners.
[[nodiscard]] std::vector<std::array<Vertex, 3>> triangles_of_least_area(std::span<const Point> walk,
                                                                         const Poll& poll);

}  // namespace holdfast::plane
