// The union of the parts of a surface.
//
// The arrangement divides space into regions, and each facet has one on either side. Components of the input
// whose borders meet in it are one. For one component, all other facets are air: regions separated only by
// them are one. The regions that its own facets separate have a winding number if the facets are consistently
// oriented; otherwise each region is inside or outside. A component inside another one that faces the other
// way is a cavity of it.
#include "api/unite.h"

#include <algorithm>
#include <array>
#include <compare>
#include <map>
#include <utility>
#include <vector>

#include "api/solids.h"
#include "api/turned.h"
#include "mesh/disjoint_sets.h"
#include "mesh/undoable_sets.h"
#include "numbers/sorted.h"
#include "surface/places.h"
#include "surface/space.h"

namespace holdfast {
namespace {

/// The connected components of the input's facets, where corners at one place are one.
std::vector<Index> components_of(const Complex& input) {
  const std::vector<Index> first = first_at_places(input.vertices);
  DisjointSets sets(input.vertices.size());
  for (const Triangle& t : input.facets) {
    if (std::any_of(t.begin(), t.end(), [&](Index v) { return v >= input.vertices.size(); })) continue;
    sets.unite(first[t[0]], first[t[1]]);
    sets.unite(first[t[1]], first[t[2]]);
  }
  std::vector<Index> component(input.facets.size(), 0);
  for (std::size_t f = 0; f < component.size(); ++f)
    if (const Index v = input.facets[f][0]; v < input.vertices.size()) component[f] = sets.root(first[v]);
  return component;
}

void keep_only(repairing::State& state, repairing::Holes& holes, const std::vector<std::uint8_t>& keep) {
  std::vector<Triangle> facets;
  std::vector<Index> number(keep.size(), no_index);
  repairing::Parents parents;
  for (std::size_t f = 0; f < keep.size(); ++f) {
    if (keep[f] == 0) continue;
    number[f] = static_cast<Index>(facets.size());
    facets.push_back(state.facets[f]);
    parents.add(state.facet_parents.of(f));
  }
  state.facets = std::move(facets);
  state.facet_parents = std::move(parents);
  state.doubt_all();
  repairing::renumber(holes, state, number, repairing::drop_unused(state));
}

/// By two regions: the components to which every facet between them belongs, ascending.
using Common = std::map<RegionPair, std::vector<Index>>;

/// For each component, the regions joined that are not separated by this component alone. Two components have
/// nearly all joins in common, so they are divided into halves again and again: what no component of a half
/// separates alone is joined for all of it.
class WithoutEach {
 public:
  WithoutEach(Index regions, std::size_t components, const Common& common_to)
      : sets_(regions), alone_(components) {
    for (const auto& wall : common_to) {
      if (wall.second.empty()) sets_.unite(wall.first.front, wall.first.back);
      for (const Index component : wall.second) alone_[component].push_back(&wall);
    }
  }

  /// Calls f(component, sets) for each component.
  template <class F>
  void visit(const F& f) {
    if (!alone_.empty()) visit({0, static_cast<Index>(alone_.size())}, f);
  }

 private:
  struct Range {
    Index first, last;
  };

  template <class F>
  void visit(Range range, const F& f) {
    if (range.last - range.first == 1) return f(range.first, sets_);
    const Index middle = range.first + (range.last - range.first) / 2;
    const Range low{range.first, middle}, high{middle, range.last};
    for (const auto& [half, other] : {std::pair(low, high), std::pair(high, low)}) {
      const std::size_t mark = sets_.mark();
      for (Index component = other.first; component < other.last; ++component) join_alone(component, half);
      visit(half, f);
      sets_.undo_to(mark);
    }
  }

  /// Joins what this component separates alone, unless a component of `half` does, too.
  void join_alone(Index component, const Range& half) {
    for (const Common::value_type* wall : alone_[component]) {
      const auto at = std::lower_bound(wall->second.begin(), wall->second.end(), half.first);
      if (at == wall->second.end() || *at >= half.last) sets_.unite(wall->first.front, wall->first.back);
    }
  }

  UndoableSets sets_;
  std::vector<std::vector<const Common::value_type*>> alone_;  // by component
};

/// What the facets of each component separate.
class ComponentWalls {
 public:
  ComponentWalls(const Complex& input, const repairing::State& state, const DividedSpace& division)
      : input_(input), state_(state), division_(division), component_(components_of(input)) {
    find_components_at_vertices();
    join_at_borders();
    for (std::size_t f = 0; f < state_.facets.size(); ++f) add_facet(f);
  }

  /// The regions that at least one component keeps.
  [[nodiscard]] std::vector<std::uint8_t> material(const Step& step) {
    for (std::vector<RegionPair>& walls : walls_) sort_unique(walls);
    std::vector<Solid> solids(walls_.size());
    WithoutEach without(division_.regions, walls_.size(), common_to_);
    without.visit([&](std::size_t component, const UndoableSets& sets) {
      step(0.9);
      solids[component] = solid_of(walls_[component], sets);
    });
    return material_of(division_.regions, solids, walls_);
  }

 private:
  void find_components_at_vertices() {
    component_at_.assign(state_.vertices.size(), 0);
    for (std::size_t f = 0; f < state_.facets.size(); ++f)
      for (const Index p : state_.facet_parents.of(f))
        for (const Index v : state_.facets[f]) component_at_[v] = component_[p];
  }

  /// The components to which a facet belongs. One that fills a hole belongs to the component that has its
  /// corners.
  [[nodiscard]] std::vector<Index> components_of_facet(std::size_t f) const {
    std::vector<Index> own;
    for (const Index p : state_.facet_parents.of(f)) own.push_back(component_[p]);
    if (own.empty()) own.push_back(component_at_[state_.facets[f][0]]);
    sort_unique(own);
    return own;
  }

  /// Components that only together enclose anything become one: a side is on the border of each of them, for
  /// example since a weld joined them there.
  void join_at_borders() {
    struct Border {
      std::array<Index, 2> side;
      Index component;
      auto operator<=>(const Border&) const = default;
    };
    std::vector<Border> borders;
    for (std::size_t f = 0; f < state_.facets.size(); ++f) {
      const Triangle& t = state_.facets[f];
      for (const Index component : components_of_facet(f))
        for (std::size_t k = 0; k < 3; ++k)
          borders.push_back({ascending(std::array{t[k], t[(k + 1) % 3]}), component});
    }
    sort_odd(borders);
    DisjointSets sets(input_.vertices.size());
    for (std::size_t i = 1; i < borders.size(); ++i)
      if (borders[i].side == borders[i - 1].side) sets.unite(borders[i].component, borders[i - 1].component);
    number_components(sets);
  }

  /// Components become 0, 1, ...
  void number_components(DisjointSets& sets) {
    std::vector<Index> number(input_.vertices.size(), no_index);
    Index count = 0;
    for (Index& component : component_) {
      Index& own = number[sets.root(component)];
      if (own == no_index) own = count++;
      component = own;
    }
    for (Index& component : component_at_) component = number[sets.root(component)];
    walls_.resize(count);
  }

  void add_facet(std::size_t f) {
    const auto [front, back] = division_.of_facet[f];
    const std::vector<Index> own = components_of_facet(f);
    for (const Index p : state_.facet_parents.of(f)) {
      const bool is_alike =
          turned_alike(state_.vertices, state_.facets[f], input_.vertices, input_.facets[p]);
      walls_[component_[p]].push_back(is_alike ? RegionPair{front, back} : RegionPair{back, front});
    }
    if (state_.facet_parents.of(f).empty()) walls_[own[0]].push_back({front, back});
    if (front != back) note_common(RegionPair{std::min(front, back), std::max(front, back)}, own);
  }

  void note_common(const RegionPair& pair, const std::vector<Index>& components) {
    const auto [at, is_new] = common_to_.try_emplace(pair, components);
    if (is_new) return;
    std::vector<Index> common;
    std::set_intersection(at->second.begin(), at->second.end(), components.begin(), components.end(),
                          std::back_inserter(common));
    at->second = std::move(common);
  }

  const Complex& input_;
  const repairing::State& state_;
  const DividedSpace& division_;
  std::vector<Index> component_;                // by facet of the input
  std::vector<Index> component_at_;             // by vertex of the arrangement
  std::vector<std::vector<RegionPair>> walls_;  // by component
  Common common_to_;
};

}  // namespace

void unite(const Complex& input, repairing::State& state, repairing::Holes& holes, const Step& step,
           const Threads& threads) {
  if (state.facets.empty()) return;
  const DividedSpace division = divide_space({state.vertices, state.facets, {}, {}, {}}, step, threads);
  const std::vector<std::uint8_t> material = ComponentWalls(input, state, division).material(step);
  std::vector<std::uint8_t> keep(state.facets.size());
  for (std::size_t f = 0; f < keep.size(); ++f)
    keep[f] = material[division.of_facet[f][0]] != material[division.of_facet[f][1]];
  keep_only(state, holes, keep);
}

}  // namespace holdfast
