// The enlarged box round a complex, so that every constraint lies strictly inside the hull
// (docs/concepts.md).
#pragma once

#include <array>
#include <span>

#include "exact/double_grid.h"
#include "holdfast/types.h"

namespace holdfast {

/// The 8 corners of a box that holds all vertices strictly inside, `margin` times their largest extent away
/// on every side, so that it is no flatter than 2 margin : 1 + 2 margin. The corners are points of the grid,
/// as the vertices are; these must be finite and below the greatest double, where the box ends at the latest.
[[nodiscard]] std::array<Point, 8> box_corners(std::span<const Point> vertices, double margin,
                                               const exact::DoubleGrid& grid = {});

}  // namespace holdfast
