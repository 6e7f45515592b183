#include "repair/part_facets.h"

#include <algorithm>
#include <cmath>

#include "numbers/sorted.h"

namespace holdfast::repairing {

PartFacets::PartFacets(const State& state, std::span<const Index> part)
    : state_(state), part_(part), planes_(state.facets.size()), parts_at_(state.vertices.size()) {
  for (Index f = 0; f < state_.facets.size(); ++f) {
    planes_[f] = plane_of(state_.facets[f]);
    if (!planes_[f]) continue;
    for (const Index v : state_.facets[f])
      for (const Index p : state_.facet_parents.of(f)) parts_at_[v].push_back(part_[p]);
  }
  for (std::vector<Index>& parts : parts_at_) sort_unique(parts);
}

std::optional<PlaneOf> PartFacets::plane_of(const Triangle& t) const {
  for (const Index v : t)
    if (v >= state_.vertices.size() || !is_finite(at(v))) return std::nullopt;
  const Vector u = at(t[1]) - at(t[0]), v = at(t[2]) - at(t[0]), w = at(t[2]) - at(t[1]);
  const double longest = std::max({length(u), length(v), length(w)});
  if (!(longest > 0) || !std::isfinite(longest)) return std::nullopt;
  Vector n = cross(over(u, longest), over(v, longest));
  const double twice_area = length(n);
  if (!(twice_area > 0x1p-40)) return std::nullopt;
  PlaneOf plane{over(n, twice_area), twice_area * longest, 0};
  for (std::size_t k = 1; k < 3; ++k)
    if (std::fabs(plane.normal[k]) > std::fabs(plane.normal[plane.axis])) plane.axis = k;
  return plane;
}

Index PartFacets::widest(const std::vector<Index>& facets) const {
  return *std::max_element(facets.begin(), facets.end(), [&](Index f, Index g) {
    return planes_[f]->height != planes_[g]->height ? planes_[f]->height < planes_[g]->height : f > g;
  });
}

double PartFacets::area(const Triangle& t, std::size_t axis) const {
  const PlanePoint a = flat(t[0], axis), b = flat(t[1], axis), c = flat(t[2], axis);
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool PartFacets::holds(const Triangle& t, const PlanePoint& p, std::size_t axis) const {
  int left = 0, right = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const PlanePoint a = flat(t[i], axis), b = flat(t[(i + 1) % 3], axis);
    const double side = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    if (side > 0) ++left;
    if (side < 0) ++right;
  }
  return left == 0 || right == 0;
}

double PartFacets::distance(const Triangle& t, Index facet) const {
  const auto& [a, b, c] = corners(facet);
  double most = 0;
  for (const Index v : t) most = std::max(most, distance_to(at(v), at(a), at(b), at(c)));
  return most;
}

}  // namespace holdfast::repairing
