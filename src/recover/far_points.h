// Points round a cavity above a facet, whose hull holds the vertices of the cavity.
#pragma once

#include <span>
#include <vector>

#include "holdfast/types.h"

namespace holdfast {

/// Corners of a box above the facet, and one point far below it. That point is so far away that a sphere
/// through it and the facet's corners contains no vertex of the cavity; so the facet is a Delaunay triangle
/// inside the hull. Of a flat cavity of an inclined facet, only four corners are above it, and at its height
/// the hull may be too narrow.
[[nodiscard]] std::vector<Point> far_points(std::span<const Point> points, const Triangle& facet);

/// The same, and all corners of the box pressed onto a plane a little above the facet: whatever the facet's
/// inclination, the hull is as wide as the box there.
[[nodiscard]] std::vector<Point> far_points_all_round(std::span<const Point> points, const Triangle& facet);

}  // namespace holdfast
