#include "repair/opened.h"

#include <algorithm>
#include <array>

#include "numbers/sorted.h"
#include "repair/near.h"
#include "surface/complex.h"
#include "surface/places.h"

namespace holdfast::repairing {
namespace {

struct Parts {
  std::vector<Index> all, open;  // in ascending order
};

/// Parts with facets, and parts with a facet that is alone at one of its sides. A facet that stands for two
/// facets of a part, as where a thin place was pressed flat, leaves no crack in the part.
Parts parts_of(const State& state, std::span<const Index> part) {
  const std::vector<Index> first = first_at_places(state.vertices);
  std::vector<std::array<Index, 3>> sides;  // ends and facet
  Parts parts;
  for (Index f = 0; f < state.facets.size(); ++f) {
    const Triangle& t = state.facets[f];
    if (std::any_of(t.begin(), t.end(),
                    [&](Index v) { return v >= first.size() || !is_finite(state.vertices[v]); }))
      continue;
    for (const Index parent : state.facet_parents.of(f)) parts.all.push_back(part[parent]);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [a, b] = ascending(std::array{first[t[i]], first[t[(i + 1) % 3]]});
      sides.push_back({a, b, f});
    }
  }
  std::sort(sides.begin(), sides.end());
  const auto same = [&](std::size_t i, std::size_t j) {
    return sides[i][0] == sides[j][0] && sides[i][1] == sides[j][1];
  };
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if ((i > 0 && same(i, i - 1)) || (i + 1 < sides.size() && same(i, i + 1))) continue;
    const auto parents = state.facet_parents.of(sides[i][2]);
    for (const Index parent : parents)
      if (std::count_if(parents.begin(), parents.end(),
                        [&](Index other) { return part[other] == part[parent]; }) %
              2 !=
          0)
        parts.open.push_back(part[parent]);
  }
  sort_unique(parts.all);
  sort_unique(parts.open);
  return parts;
}

}  // namespace

Index opened_part(const State& before, const State& after, std::span<const Index> part) {
  const Parts given = parts_of(before, part), now = parts_of(after, part);
  const auto has = [](const std::vector<Index>& parts, Index p) {
    return std::binary_search(parts.begin(), parts.end(), p);
  };
  for (const Index p : given.all)
    if (!has(given.open, p) && (has(now.open, p) || !has(now.all, p))) return p;
  return no_index;
}

}  // namespace holdfast::repairing
