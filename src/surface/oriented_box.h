// Surface layer: oriented boxes round sets of points. They separate bundles of long needles whose
// axis-aligned boxes all overlap (after Gottschalk, Lin, Manocha 1996, "OBBTree").
//
// They serve the search only: boxes are computed in floating point with a margin far above the rounding
// errors, so "apart" is certain and "not apart" says nothing.
#pragma once

#include <array>
#include <vector>

#include "holdfast/types.h"
#include "surface/aabb_tree.h"

namespace holdfast {

/// Maps `box` to the cube [-1, 1]^3.
class UnitFrame {
 public:
  explicit UnitFrame(const Box& box);
  [[nodiscard]] Point operator()(const double* p) const;

 private:
  Point origin_;
  double scale_;
};

/// The points c + sum s_i axis_i with |s_i| <= half_i, in unit coordinates; the axes are orthonormal.
struct OrientedBox {
  Point centre{};
  std::array<Point, 3> axis{};
  Point half{};
};

/// A box of the points, parallel to the longest side of the triangles that successive points form, and to
/// that triangle's plane. `corners` holds three points a triangle in unit coordinates, for at least one
/// triangle.
[[nodiscard]] OrientedBox oriented_box(const std::vector<std::array<Point, 3>>& corners);

/// True only if the boxes are disjoint.
[[nodiscard]] bool surely_apart(const OrientedBox& a, const OrientedBox& b);

}  // namespace holdfast
