#include "repair/glue.h"

#include <algorithm>
#include <numeric>

#include "numbers/sorted.h"
#include "surface/complex.h"
#include "surface/places.h"

namespace holdfast::repairing {
namespace {

/// Facets ordered by the places of their corners, and the corners of each.
class ByCorners {
 public:
  explicit ByCorners(const State& state) : order_(state.facets.size()) {
    const std::vector<Index> first = first_at_places(state.vertices);
    corners_.reserve(state.facets.size());
    const auto place = [&](Index v) { return v < first.size() ? first[v] : v; };
    for (const Triangle& t : state.facets)
      corners_.push_back(ascending(Triangle{place(t[0]), place(t[1]), place(t[2])}));
    std::iota(order_.begin(), order_.end(), Index{0});
    std::sort(order_.begin(), order_.end(), [&](Index f, Index g) {
      return corners_[f] != corners_[g] ? corners_[f] < corners_[g] : f < g;
    });
  }

  /// Calls visit(facets) for each set of several facets with the same corners, in ascending order.
  template <class Visit>
  void for_each_repeated(Visit&& visit) const {
    for (std::size_t i = 0, j = 0; i < order_.size(); i = j) {
      for (j = i + 1; j < order_.size() && corners_[order_[j]] == corners_[order_[i]];) ++j;
      if (j > i + 1) visit(std::span(order_).subspan(i, j - i));
    }
  }

 private:
  std::vector<Triangle> corners_;
  std::vector<Index> order_;
};

}  // namespace

void glue(State& state, std::span<const Index> part) {
  std::vector<Index> into(state.facets.size());
  std::iota(into.begin(), into.end(), Index{0});
  std::vector<std::vector<Index>> joined(0);
  std::vector<Index> slot(state.facets.size(), no_index);  // in `joined`
  const auto parts_of = [&](Index f) {
    std::vector<Index> parts;
    const auto add = [&](std::span<const Index> parents) {
      for (const Index p : parents) parts.push_back(part[p]);
    };
    add(state.facet_parents.of(f));
    if (slot[f] != no_index)
      for (const Index g : joined[slot[f]]) add(state.facet_parents.of(g));
    sort_unique(parts);
    return parts;
  };
  ByCorners(state).for_each_repeated([&](std::span<const Index> same) {
    std::vector<Index> kept;
    for (const Index f : same) {
      const std::vector<Index> own = parts_of(f);
      const auto other = std::find_if(kept.begin(), kept.end(), [&](Index k) {
        const std::vector<Index> of = parts_of(k);
        return std::none_of(own.begin(), own.end(),
                            [&](Index p) { return std::binary_search(of.begin(), of.end(), p); });
      });
      if (other == kept.end()) {
        kept.push_back(f);
        continue;
      }
      into[f] = *other;
      if (slot[*other] == no_index) {
        slot[*other] = static_cast<Index>(joined.size());
        joined.emplace_back();
      }
      joined[slot[*other]].push_back(f);
    }
  });
  if (joined.empty()) return;

  std::vector<Triangle> facets;
  Parents parents;
  std::vector<std::uint8_t> known;
  std::vector<Index> list;
  for (Index f = 0; f < state.facets.size(); ++f) {
    if (into[f] != f) continue;
    facets.push_back(state.facets[f]);
    list.assign(state.facet_parents.of(f).begin(), state.facet_parents.of(f).end());
    if (slot[f] != no_index)
      for (const Index g : joined[slot[f]])
        list.insert(list.end(), state.facet_parents.of(g).begin(), state.facet_parents.of(g).end());
    sort_unique(list);
    parents.add(list);
    if (!state.known.empty()) known.push_back(state.known[f]);
  }
  state.facets = std::move(facets);
  state.facet_parents = std::move(parents);
  state.known = std::move(known);
  state.sheet.clear();
}

}  // namespace holdfast::repairing
