// Where three facets cross each other.
#include "arrange/crossings.h"

#include <algorithm>
#include <utility>

namespace holdfast::arrange {

Crossings::Crossings(const Complex& complex, const Elements& elements, const std::vector<std::uint8_t>& cut,
                     const Threads& threads)
    : plane_(cut.size(), no_index) {
  std::vector<Index> facets;
  for (Index i = 0; i < cut.size(); ++i) {
    if (cut[i] == 0) continue;
    plane_[i] = static_cast<Index>(facets.size());
    facets.push_back(i);
  }
  planes_.resize(facets.size());
  parallel_ranges(threads, facets.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      const auto& [a, b, c] = elements.all[facets[k]].vertex;
      const auto at = [&](Index v) { return complex.vertices[v].data(); };
      planes_[k] = exact::plane_through(at(a), at(b), at(c));
    }
  });
}

CrossingPoint& Crossings::of_facets(std::array<Index, 3> facets) {
  std::sort(facets.begin(), facets.end());
  Part& part = parts_[(facets[0] * 31u + facets[1] * 7u + facets[2]) % parts_.size()];
  const std::lock_guard lock(part.mutex);
  const auto [at, is_new] = part.of_facets.try_emplace(facets);
  if (is_new) {
    exact::SpacePoint point = exact::crossing(plane_of(facets[0]), plane_of(facets[1]), plane_of(facets[2]));
    const Point nearest = exact::nearest(point);
    at->second = &part.all.emplace_back(CrossingPoint{std::move(point), nearest});
  }
  return *at->second;
}

CrossingPoint& Crossings::add(exact::SpacePoint point) {
  const Point nearest = exact::nearest(point);
  Part& part = parts_[0];
  const std::lock_guard lock(part.mutex);
  return part.all.emplace_back(CrossingPoint{std::move(point), nearest});
}

}  // namespace holdfast::arrange
