// From a plane back into space.
#pragma once

#include <cmath>

#include "holdfast/plane.h"

namespace holdfast::plane {

/// Maps points of a plane back into space.
class Lift {
 public:
  Lift(const PlanesInSpace& planes, const PlanesInSpace::Part& part) : planes_(planes), part_(part) {
    const auto count = static_cast<double>(part.numbers.size());
    for (const Index number : part.numbers)
      for (std::size_t k = 0; k < 3; ++k) middle_[k] += planes.points[number][k] / count;
  }

  /// Maps a point onto the mean plane.
  [[nodiscard]] Point operator()(const PlanePoint& p) const {
    const std::size_t u = (part_.axis + 1) % 3, v = (part_.axis + 2) % 3;
    const Point& n = part_.normal;
    return place(p, middle_[part_.axis] - (n[u] / n[part_.axis] * (p[0] - middle_[u]) +
                                           n[v] / n[part_.axis] * (p[1] - middle_[v])));
  }
  /// Maps a point onto the segment from a to b, by their numbers in the plane.
  [[nodiscard]] Point on_segment(const PlanePoint& p, Index a, Index b) const {
    const PlanePoint &q = part_.plane.points[a], &r = part_.plane.points[b];
    const double whole = std::abs(r[0] / 2 - q[0] / 2) + std::abs(r[1] / 2 - q[1] / 2);
    const double share = (std::abs(p[0] / 2 - q[0] / 2) + std::abs(p[1] / 2 - q[1] / 2)) / whole;
    const double from = in_space(a)[part_.axis], to = in_space(b)[part_.axis];
    return place(p, (1 - share) * from + share * to);
  }
  [[nodiscard]] const Point& in_space(Index v) const { return planes_.points[part_.numbers[v]]; }

 private:
  [[nodiscard]] Point place(const PlanePoint& p, double height) const {
    Point lifted{};
    lifted[(part_.axis + 1) % 3] = p[0];
    lifted[(part_.axis + 2) % 3] = p[1];
    lifted[part_.axis] = height;
    return lifted;
  }

  const PlanesInSpace& planes_;
  const PlanesInSpace::Part& part_;
  Point middle_{};
};

}  // namespace holdfast::plane
