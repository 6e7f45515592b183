// Check of repairs: whether points lie within a distance of points, segments and triangles, exactly.
#pragma once

#include "check/intersect.h"
#include "exact/dyadic.h"
#include "holdfast/types.h"

namespace holdfast::checking {

/// Whether p, both ends or all corners, lie within `distance` of something. Distance to a convex set is a
/// convex function: what holds of the corners of a triangle or segment holds of all of its points.
class Reach {
 public:
  /// `distance` must be finite and not negative.
  explicit Reach(double distance);

  [[nodiscard]] double distance() const { return distance_; }
  [[nodiscard]] bool of_point(const Point& p, const Point& a) const;
  [[nodiscard]] bool of_segment(const Point& p, const Point& a, const Point& b) const;
  /// The triangle may be of zero area.
  [[nodiscard]] bool of_triangle(const Point& p, const std::array<Point, 3>& t) const;

 private:
  [[nodiscard]] bool surely_of_triangle(const Point& p, const std::array<Point, 3>& t) const;

  double distance_;
  exact::Dyadic square_;  // of the distance
};

/// Sign of |p - q| - distance.
[[nodiscard]] int compare_distance(const Point& p, const Point& q, double distance);

/// Whether the circle inscribed in a triangle has a radius of at most `distance` (not negative): by no map
/// that moves its points less than that radius does the triangle lose its inside.
[[nodiscard]] bool inscribed_at_most(const std::array<Point, 3>& t, double distance);

/// |p - q| to within a few units in the last place, for messages; infinity where it overflows.
[[nodiscard]] double rough_distance(const Point& p, const Point& q);
/// Of a point and a triangle, likewise.
[[nodiscard]] double rough_distance(const Point& p, const std::array<Point, 3>& t);

}  // namespace holdfast::checking
