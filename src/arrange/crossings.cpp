// Where three facets cross each other.
#include "arrange/crossings.h"

#include <algorithm>
#include <utility>

namespace holdfast::arrange {

CrossingPoint& Crossings::of_facets(std::array<Index, 3> facets) {
  std::sort(facets.begin(), facets.end());
  Part& part = parts_[(facets[0] * 31u + facets[1] * 7u + facets[2]) % parts_.size()];
  const std::lock_guard lock(part.mutex);
  const auto fresh = static_cast<Index>(part.all.size());
  const Index number = part.of_facets.find_or_add(facets, fresh);
  if (number == fresh) {
    exact::SpacePoint point = exact::crossing(planes_[facets[0]], planes_[facets[1]], planes_[facets[2]]);
    const Point nearest = exact::nearest(point);
    part.all.push_back({std::move(point), nearest});
  }
  return part.all[number];
}

CrossingPoint& Crossings::add(exact::SpacePoint point) {
  const Point nearest = exact::nearest(point);
  Part& part = parts_[0];
  const std::lock_guard lock(part.mutex);
  return part.all.emplace_back(CrossingPoint{std::move(point), nearest});
}

}  // namespace holdfast::arrange
