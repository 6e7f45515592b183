// The union of the parts of a surface.
//
// The arrangement divides space into regions, and each facet has one on either side. Components of the input
// whose borders meet in it are one. For one component, all other facets are air: regions separated only by
// them are one. The regions that its own facets separate have a winding number if the facets are consistently
// oriented; otherwise each region is inside or outside.
#include "api/unite.h"

#include <algorithm>
#include <array>
#include <compare>
#include <map>
#include <optional>

#include "api/turned.h"
#include "mesh/disjoint_sets.h"
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

/// The regions on both sides of a facet of the arrangement that is part of a component's facet.
struct RegionPair {
  Index front, back;
  bool operator<(const RegionPair& other) const {
    return std::pair(front, back) < std::pair(other.front, other.back);
  }
  bool operator==(const RegionPair&) const = default;
};

/// The regions that a component keeps. `airs` are pairs of regions separated by a facet of another component.
std::vector<std::uint8_t> material_of(std::size_t regions, const std::vector<RegionPair>& walls,
                                      const std::vector<RegionPair>& airs) {
  DisjointSets sets(regions);
  for (const RegionPair& air : airs) sets.unite(air.front, air.back);
  std::vector<std::optional<int>> winding(regions);
  std::map<Index, std::vector<std::pair<Index, int>>> steps;
  for (const RegionPair& wall : walls) {
    const Index front = sets.root(wall.front), back = sets.root(wall.back);
    if (front == back) continue;
    steps[front].emplace_back(back, 1);  // the inside is behind a facet that faces outwards
    steps[back].emplace_back(front, -1);
  }
  bool consistent = true;
  std::vector<Index> open{sets.root(0)};
  winding[open[0]] = 0;
  while (!open.empty()) {
    const Index region = open.back();
    open.pop_back();
    for (const auto& [next, step] : steps[region]) {
      const int expected = *winding[region] + step;
      if (!winding[next]) {
        winding[next] = expected;
        open.push_back(next);
      } else if (*winding[next] != expected) {
        consistent = false;
      }
    }
  }
  std::vector<std::uint8_t> material(regions, 0);
  for (Index r = 0; r < regions; ++r) {
    const Index root = sets.root(r);
    material[r] = consistent ? winding[root].value_or(0) != 0 : root != sets.root(0);
  }
  return material;
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
    std::vector<std::uint8_t> material(division_.regions, 0);
    for (auto& [component, walls] : walls_) {
      step(0.9);
      sort_unique(walls);
      std::vector<RegionPair> airs;
      for (const auto& [pair, common] : common_to_)
        if (!std::binary_search(common.begin(), common.end(), component)) airs.push_back(pair);
      const std::vector<std::uint8_t> own = material_of(division_.regions, walls, airs);
      for (std::size_t r = 0; r < material.size(); ++r) material[r] = material[r] | own[r];
    }
    return material;
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
    for (Index& component : component_) component = sets.root(component);
    for (Index& component : component_at_) component = sets.root(component);
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
  std::vector<Index> component_;                    // by facet of the input
  std::vector<Index> component_at_;                 // by vertex of the arrangement
  std::map<Index, std::vector<RegionPair>> walls_;  // by component
  // By two regions: the components to which every facet between them belongs.
  std::map<RegionPair, std::vector<Index>> common_to_;
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
