// How far parts are from each other.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "holdfast/types.h"

namespace holdfast {

struct NearestPoints {
  double distance;
  std::array<Point, 2> points;  ///< one on a facet of each set
};

/// The least distance between two sets of facets with finite vertices, in floating point; neither is empty.
/// `step` is called now and then, and may throw.
[[nodiscard]] NearestPoints nearest_points(std::span<const Point> vertices, std::span<const Triangle> first,
                                           std::span<const Triangle> second,
                                           const std::function<void()>& step);

}  // namespace holdfast
