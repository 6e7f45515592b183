#include "repair/repeated.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "arrange/index_table.h"
#include "numbers/finite.h"
#include "numbers/sorted.h"
#include "surface/places.h"

namespace holdfast::repairing {

std::size_t merge_repeated(State& state) {
  const std::vector<Index> first = places_of(state.complex()).first;
  const auto is_usable = [&](Index v) { return v < first.size() && is_finite(state.vertices[v]); };
  arrange::IndexTable<3> with;                     // the first facet with some corners
  std::vector<Index> into(state.facets.size());    // for each facet, the first with the same corners
  std::vector<Index> copies(state.facets.size());  // how many others have them
  std::size_t repeated = 0;
  for (Index f = 0; f < into.size(); ++f) {
    const Triangle& t = state.facets[f];
    into[f] = f;
    if (!std::all_of(t.begin(), t.end(), is_usable)) continue;
    into[f] = with.find_or_add(ascending(Triangle{first[t[0]], first[t[1]], first[t[2]]}), f);
    if (into[f] == f) continue;
    ++copies[into[f]];
    ++repeated;
  }
  if (repeated == 0) return 0;
  std::vector<std::vector<Index>> parents(into.size());  // of facets with copies
  for (Index f = 0; f < into.size(); ++f) {
    if (into[f] == f && copies[f] == 0) continue;
    const auto own = state.facet_parents.of(f);
    parents[into[f]].insert(parents[into[f]].end(), own.begin(), own.end());
  }
  std::vector<Triangle> facets;
  Parents kept;
  facets.reserve(into.size() - repeated);
  for (Index f = 0; f < into.size(); ++f) {
    if (into[f] != f) continue;
    facets.push_back(state.facets[f]);
    if (copies[f] == 0) {
      kept.add(state.facet_parents.of(f));
      continue;
    }
    for (Index& v : facets.back()) v = first[v];
    sort_unique(parents[f]);
    kept.add(parents[f]);
  }
  state.facets = std::move(facets);
  state.facet_parents = std::move(kept);
  state.doubt_all();
  return repeated;
}

}  // namespace holdfast::repairing
