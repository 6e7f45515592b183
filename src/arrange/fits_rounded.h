// Whether the triangles of a sheet still fit together once its points are rounded.
#pragma once

#include "plane/points.h"
#include "plane/triangles.h"

namespace holdfast::arrange {

/// If true, the triangles meet only in common vertices and edges when all points stand at their nearest
/// doubles; false says nothing. The triangles triangulate a triangle whose corners are points 0, 1, 2 in some
/// order; other points may lie on its sides.
///
/// If all triangles turn left and the border is a simple polygon, the map from the exact triangulation to the
/// rounded one is injective: as many triangles hold a point inside as the border winds round it, once.
[[nodiscard]] bool fits_rounded(const plane::Triangles& triangles, const plane::Points& points);

}  // namespace holdfast::arrange
