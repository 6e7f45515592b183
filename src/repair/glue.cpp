#include "repair/glue.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

#include "numbers/sorted.h"
#include "repair/derived_facets.h"
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

/// Which facets become one.
class Gluing {
 public:
  Gluing(const State& state, std::span<const Index> part)
      : state_(state), part_(part), is_gone_(state.facets.size(), 0) {
    ByCorners(state).for_each_repeated([this](std::span<const Index> same) { join(same); });
  }

  [[nodiscard]] bool is_empty() const { return joined_.empty(); }

  void deliver(State& state) const {
    DerivedFacets facets(state);
    std::vector<std::uint8_t> known;
    for (Index f = 0; f < state.facets.size(); ++f) {
      if (is_gone_[f] != 0) continue;
      facets.add(state.facets[f], with_joined(f));
      if (!state.known.empty()) known.push_back(state.known[f]);
    }
    std::move(facets).move_to(state);
    state.known = std::move(known);
    state.sheet.clear();
  }

 private:
  /// Each of these facets becomes one with the first that has none of its parts.
  void join(std::span<const Index> same) {
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
      is_gone_[f] = 1;
      joined_[*other].push_back(f);
    }
  }

  /// A facet and those that became one with it.
  [[nodiscard]] std::vector<Index> with_joined(Index f) const {
    std::vector<Index> all{f};
    if (const auto found = joined_.find(f); found != joined_.end())
      all.insert(all.end(), found->second.begin(), found->second.end());
    return all;
  }

  [[nodiscard]] std::vector<Index> parts_of(Index f) const {
    std::vector<Index> parts;
    for (const Index g : with_joined(f))
      for (const Index p : state_.facet_parents.of(g)) parts.push_back(part_[p]);
    sort_unique(parts);
    return parts;
  }

  const State& state_;
  const std::span<const Index> part_;  // by parent
  std::vector<std::uint8_t> is_gone_;
  std::map<Index, std::vector<Index>> joined_;  // by the facet that is kept
};

}  // namespace

void glue(State& state, std::span<const Index> part) {
  const Gluing gluing(state, part);
  if (!gluing.is_empty()) gluing.deliver(state);
}

}  // namespace holdfast::repairing
