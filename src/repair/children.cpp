#include "repair/children.h"

#include <algorithm>

namespace holdfast::repairing {

Children::Children(const State& state, const State& given) : given_(given) {
  Index parents = 0;
  for (const Index p : state.facet_parents.all) parents = std::max(parents, p + 1);
  by_parent_.resize(parents);
  for (Index f = 0; f < state.facets.size(); ++f)
    for (const Index p : state.facet_parents.of(f)) by_parent_[p].push_back(f);
}

std::span<const Index> Children::of(Index facet) const {
  const auto parents = given_.facet_parents.of(facet);
  if (parents.empty() || parents[0] >= by_parent_.size()) return {};
  return by_parent_[parents[0]];
}

}  // namespace holdfast::repairing
