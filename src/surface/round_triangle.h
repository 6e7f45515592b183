// Surface layer: triangles with a margin round sets of points. The facets into which a triangle was cut lie
// in one that is far thinner than an oriented box.
//
// They serve the search only, in unit coordinates (oriented_box.h), with a margin far above rounding errors:
// "apart" is certain and "not apart" says nothing.
#pragma once

#include <array>
#include <vector>

#include "holdfast/types.h"

namespace holdfast {

/// All points at most a margin from a triangle.
class RoundTriangle {
 public:
  /// Contains the points, three for each of at least one triangle. It is as narrow as can be if these form a
  /// triangle except for rounding.
  explicit RoundTriangle(const std::vector<std::array<Point, 3>>& corners);

  /// True only if the two are disjoint.
  friend bool surely_apart(const RoundTriangle& a, const RoundTriangle& b);

 private:
  /// A direction, and the triangle's extent along it.
  struct Axis {
    Point direction;
    double size;  // at least its length
    double low, high;
  };

  [[nodiscard]] Axis axis(const Point& direction) const;
  [[nodiscard]] bool is_apart_along(const Axis& axis, const RoundTriangle& other) const;

  std::array<Point, 3> corner_{}, side_{};  // sides opposite corners
  double margin_ = 0;
  std::array<Axis, 4> own_{};  // the normal, and those of the sides in the plane
};

bool surely_apart(const RoundTriangle& a, const RoundTriangle& b);

}  // namespace holdfast
