// Joins vertices that lie close to each other, or to a side or facet, within the user's tolerance.
#include "repair/weld.h"

#include <algorithm>
#include <array>
#include <limits>

#include "numbers/sorted.h"
#include "repair/bounds.h"
#include "repair/near.h"
#include "surface/aabb_tree.h"

namespace holdfast::repairing {

double weld(State& state, double tolerance, const Step& step, Touching touching) {
  Work work;
  return weld(state, tolerance, work, step, touching);
}

double weld(State& state, double tolerance, Work& work, const Step& step, Touching touching) {
  constexpr double kRoomForRounding = 0x1p-20;  // as a share of the tolerance
  const double gap = tolerance * (1 - kRoomForRounding);
  // If two patches cut the curve between them differently, their sides cross between the vertices. So do the
  // edges of bodies that touch each other there. Sheets that coincide are left to `flatten`: their triangles
  // cross each other at all sides, and vertices there would not make them the same. Within a body, what is
  // thinner than the tolerance stays, unless it is so thin that hardly any mesh could be in it.
  const bool is_thin = tolerance <= kThinnest * last_bit(state.vertices);
  const Passings passings = is_thin ? Passings::edges : Passings::bodies;
  return settle(state, everything(state), {gap, gap, true, passings, SIZE_MAX, touching}, work, step);
}

std::optional<double> distance_of_twins(const State& state, const Trouble& trouble, double share,
                                        double widest, const Step& step) {
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
  const auto enough = least.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(least.size()));
  std::nth_element(least.begin(), enough, least.end());
  if (*enough > widest) return std::nullopt;
  return *enough;
}

}  // namespace holdfast::repairing
