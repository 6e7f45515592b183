// Distances between points, sides and facets in floating point, to choose what is joined.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "holdfast/types.h"
#include "numbers/finite.h"

namespace holdfast::repairing {

using Vector = std::array<double, 3>;

inline Vector minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double dot(const Vector& u, const Vector& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }
inline Vector cross(const Vector& u, const Vector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
inline Vector over(const Vector& u, double by) { return {u[0] / by, u[1] / by, u[2] / by}; }
inline double length(const Vector& u) {
  const double most = std::max({std::fabs(u[0]), std::fabs(u[1]), std::fabs(u[2])});
  if (!(most > 0) || !std::isfinite(most)) return most;
  const Vector v = over(u, most);
  return most * std::sqrt(dot(v, v));
}

/// Where a point stands beside the inside of a side or facet; an infinite distance elsewhere.
struct Nearness {
  double distance = std::numeric_limits<double>::infinity();
  double t = 0;     ///< along the side
  Point foot{};     ///< the point below
  double size = 0;  ///< of the numbers that the distance was computed from
  double tilt =
      0;  ///< error of the distance from a sliver, whose normal is as uncertain as its area is small

  /// Of the distance, whose error is some last bits of these.
  [[nodiscard]] double bound() const { return distance + size * 0x1p-49; }
};

/// Beside the inside of the side ab.
[[nodiscard]] Nearness beside_side(const Point& p, const Point& a, const Point& b);
/// Beside the inside of the facet abc.
[[nodiscard]] Nearness beside_facet(const Point& p, const Point& a, const Point& b, const Point& c);

/// Where two sides are nearest to each other, if that is inside both; an infinite distance elsewhere.
struct Passing {
  double distance = std::numeric_limits<double>::infinity();
  double t = 0, s = 0;  ///< along each
  Point on_first{}, on_second{};
};
[[nodiscard]] Passing pass(const Point& a, const Point& b, const Point& c, const Point& d);

/// From a point to a side or to a facet, rounded up.
[[nodiscard]] double distance_above(const Point& p, const Point& a, const Point& b);
[[nodiscard]] double distance_above(const Point& p, const Point& a, const Point& b, const Point& c);

/// From a point to a facet.
[[nodiscard]] double distance_to(const Point& p, const Point& a, const Point& b, const Point& c);

}  // namespace holdfast::repairing
