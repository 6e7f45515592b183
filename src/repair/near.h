// Distances between points, sides and facets in floating point. They choose what is joined; exact tests
// decide what is valid.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "holdfast/types.h"
#include "numbers/finite.h"
#include "numbers/vector.h"

namespace holdfast::repairing {

inline Vector over(const Vector& u, double by) { return {u[0] / by, u[1] / by, u[2] / by}; }
/// As holdfast::length, for coordinates of any size: no square over- or underflows.
inline double length(const Vector& u) {
  const double most = std::max({std::fabs(u[0]), std::fabs(u[1]), std::fabs(u[2])});
  if (!(most > 0) || !std::isfinite(most)) return most;
  const Vector v = over(u, most);
  return most * std::sqrt(dot(v, v));
}

/// The foot of a point on a side or facet, if the foot is inside; an infinite distance otherwise.
struct Nearness {
  double distance = std::numeric_limits<double>::infinity();
  double t = 0;     ///< along the side
  Point foot{};     ///< the point below
  double size = 0;  ///< magnitude of the numbers behind the distance
  /// For facets, the distance from the point of the facet that is the foot in floating point. The normal of a
  /// sliver is uncertain, and so is the distance along it; this one is not, and is never too small.
  double reach = 0;
  /// Error of the distance from a sliver, whose normal is uncertain because its area is small.
  double tilt = 0;

  /// Of the distance, whose error is some last bits of these.
  [[nodiscard]] double bound() const { return std::max(distance, reach) + size * 0x1p-49; }
};

/// Beside the inside of the side ab.
[[nodiscard]] Nearness beside_side(const Point& p, const Point& a, const Point& b);
/// Beside the inside of the facet abc.
[[nodiscard]] Nearness beside_facet(const Point& p, const Point& a, const Point& b, const Point& c);

/// Tells points that are surely farther than a distance from a facet, in a few products: they are farther
/// from its plane, or from the facet across one of its sides. The margins are several times the rounding
/// errors, for slivers, too.
class FarFromFacet {
 public:
  FarFromFacet(const Point& a, const Point& b, const Point& c, double distance);

  [[nodiscard]] bool operator()(const Point& p) const {
    const Vector w = p - origin_;
    const double size = std::fabs(w[0]) + std::fabs(w[1]) + std::fabs(w[2]);
    return std::any_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
      return dot(w, plane.normal) > plane.least + plane.error * size;
    });
  }

 private:
  /// Points w beyond it have a product with the normal of more than `least`, with an error of `error` times
  /// the size of w.
  struct Plane {
    Vector normal;
    double least, error;
  };

  Point origin_;
  std::array<Plane, 5> planes_;
};

/// The nearest points of two sides, if they are inside both; an infinite distance otherwise.
struct Passing {
  double distance = std::numeric_limits<double>::infinity();
  double t = 0, s = 0;  ///< along each
  Point on_first{}, on_second{};
};
[[nodiscard]] Passing pass(const Point& a, const Point& b, const Point& c, const Point& d);

/// Distance from a point to a side or a facet, rounded up.
[[nodiscard]] double distance_above(const Point& p, const Point& a, const Point& b);
[[nodiscard]] double distance_above(const Point& p, const Point& a, const Point& b, const Point& c);

/// Distance from a point to a facet.
[[nodiscard]] double distance_to(const Point& p, const Point& a, const Point& b, const Point& c);

}  // namespace holdfast::repairing
