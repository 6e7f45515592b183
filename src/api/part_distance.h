// The distance between parts.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "holdfast/types.h"

namespace holdfast {

struct NearestPoints {
  double distance;
  std::array<Point, 2> points;  ///< one from each set
};

/// The least distance, in floating point, between two nonempty sets of facets with finite vertices. `step` is
/// called now and then, and may throw.
[[nodiscard]] NearestPoints nearest_points(std::span<const Point> vertices, std::span<const Triangle> first,
                                           std::span<const Triangle> second,
                                           const std::function<void()>& step);

}  // namespace holdfast
