// Surface layer: oriented boxes round sets of points, to tell bundles of long needles apart that every
// axis-aligned box mixes up (after Gottschalk, Lin, Manocha 1996, "OBBTree").
//
// A means of search only: boxes are computed in floating point with a margin far above its rounding
// errors, so that "apart" is sure, and "not apart" says nothing.
#pragma once

#include <array>
#include <vector>

#include "holdfast/types.h"
#include "surface/aabb_tree.h"

namespace holdfast {

/// Coordinates of the cube [-1, 1]^3 for all that lies in `box`.
class UnitFrame {
 public:
  explicit UnitFrame(const Box& box);
  [[nodiscard]] Point operator()(const double* p) const;

 private:
  Point origin_;
  double scale_;
};

/// The points c + sum s_i axis_i with |s_i| <= half_i; in unit coordinates, the axes orthonormal.
struct OrientedBox {
  Point centre{};
  std::array<Point, 3> axis{};
  Point half{};
};

/// A box of the points, parallel to the longest side of the triangles that successive points form, and to
/// that triangle's plane. `corners` holds three unit coordinates a triangle, at least one triangle.
[[nodiscard]] OrientedBox oriented_box(const std::vector<std::array<Point, 3>>& corners);

/// True only if the boxes are disjoint.
[[nodiscard]] bool surely_apart(const OrientedBox& a, const OrientedBox& b);

}  // namespace holdfast
