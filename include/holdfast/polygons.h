// Polygons as triangles, cut as readers cut them.
#pragma once

#include <span>
#include <vector>

#include "holdfast/export.h"
#include "holdfast/types.h"

namespace holdfast {

struct CutPolygons {
  std::vector<Triangle> triangles;  ///< one polygon after another, each with its polygon's orientation
  std::vector<Index> polygons;      ///< for each triangle, the number of its polygon
  /// Largest distance of a corner from its polygon's mean plane; 0 if rounding explains it.
  double deviation = 0;
  std::size_t crossing = 0;  ///< polygons whose sides cross or overlap, seen along their normal
};

/// Cuts polygons of three corners or more into triangles. Polygon i has the corners from `offsets[i]` to, but
/// without, `offsets[i + 1]`; a corner at the place of the one before it does not count.
/// - A triangle stays as it is, and a convex polygon becomes a fan, plane or not.
/// - Any other becomes constrained Delaunay triangles as seen along its normal, or along another axis where
///   its sides cross there.
/// - One whose sides cross all the same becomes triangles of least area (Klincsek 1980), which may cross. One
///   whose corners are on a line or not finite becomes a fan. `diagnose` names what is wrong with these
///   triangles, and `repair` resolves it.
/// Throws std::invalid_argument for offsets that do not ascend from 0 to the number of corners, for a polygon
/// of fewer than three corners, and for a corner that names no vertex.
[[nodiscard]] HOLDFAST_API CutPolygons cut_polygons(std::span<const Point> vertices,
                                                    std::span<const Index> corners,
                                                    std::span<const std::size_t> offsets);

}  // namespace holdfast
