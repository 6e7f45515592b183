// Joins vertices that lie close to each other, or to a side or facet, within the user's tolerance.
#include "repair/weld.h"

#include <algorithm>
#include <array>
#include <limits>

#include "numbers/sorted.h"
#include "repair/near.h"
#include "surface/aabb_tree.h"

namespace holdfast::repairing {
namespace {

bool is_usable(const State& state, std::span<const Index> corners) {
  return std::all_of(corners.begin(), corners.end(),
                     [&](Index v) { return v < state.vertices.size() && is_finite(state.vertices[v]); });
}

}  // namespace

double weld(State& state, double tolerance, const Step& step) {
  Trouble all;
  for (Index f = 0; f < state.facets.size(); ++f)
    if (is_usable(state, state.facets[f])) all.facets.push_back(f);
  for (Index s = 0; s < state.segments.size(); ++s)
    if (is_usable(state, state.segments[s])) all.segments.push_back(s);
  constexpr double kRoomForRounding = 0x1p-20;  // as a share of the tolerance
  const double gap = tolerance * (1 - kRoomForRounding);
  Work work;
  // If two patches cut the curve between them differently, their sides cross between the vertices.
  return settle(state, all, {gap, gap, true, Passings::free}, work, step);
}

std::optional<double> distance_of_twins(const State& state, const Trouble& trouble, double widest,
                                        const Step& step) {
  std::vector<Index> vertices;
  const auto list = [&](std::span<const Index> corners) {
    for (const Index v : corners)
      if (v < state.input_vertices) vertices.push_back(v);
  };
  for (const Index f : trouble.facets) list(state.facets[f]);
  for (const Index s : trouble.segments) list(state.segments[s]);
  sort_unique(vertices);
  std::vector<Box> boxes;
  boxes.reserve(vertices.size());
  for (const Index v : vertices) boxes.push_back(box_round(state, std::array{v}, widest / 2));
  std::vector<double> least(vertices.size(), std::numeric_limits<double>::infinity());
  const auto visit = [&](Index i, Index j) {
    const Point &p = state.vertices[vertices[i]], &q = state.vertices[vertices[j]];
    if (p == q) return true;
    const double distance = length(p - q);
    least[i] = std::min(least[i], distance);
    least[j] = std::min(least[j], distance);
    return true;
  };
  AabbTree(boxes).for_each_overlap(
      visit, [](Index, Index) { return false; }, step);
  if (least.empty()) return std::nullopt;
  const auto middle = least.begin() + static_cast<std::ptrdiff_t>(least.size() / 2);
  std::nth_element(least.begin(), middle, least.end());
  if (*middle > widest) return std::nullopt;
  return *middle;
}

}  // namespace holdfast::repairing
