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
    const exact::SpacePoint point =
        exact::crossing(planes_[facets[0]], planes_[facets[1]], planes_[facets[2]]);
    part.all.push_back({exact::PackedPoint(point), exact::nearest(point)});
  }
  return part.all[number];
}

CrossingPoint& Crossings::add(const exact::SpacePoint& point) {
  CrossingPoint crossing{exact::PackedPoint(point), exact::nearest(point)};
  Part& part = parts_[0];
  const std::lock_guard lock(part.mutex);
  return part.all.emplace_back(std::move(crossing));
}

}  // namespace holdfast::arrange
