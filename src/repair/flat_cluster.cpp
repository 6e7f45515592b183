#include "repair/flat_cluster.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "numbers/sorted.h"
#include "surface/complex.h"

namespace holdfast::repairing {

Flat flat_of(const State& state, const Cluster& cluster) {
  Flat flat;
  for (const Index f : cluster.facets) {
    const Triangle& t = state.facets[f];
    flat.vertices.insert(flat.vertices.end(), t.begin(), t.end());
    for (std::size_t i = 0; i < 3; ++i) flat.sides.push_back(ascending(Side{t[i], t[(i + 1) % 3]}));
  }
  sort_unique(flat.vertices);
  sort_unique(flat.sides);
  const auto number = [&](Index v) {
    return static_cast<Index>(std::lower_bound(flat.vertices.begin(), flat.vertices.end(), v) -
                              flat.vertices.begin());
  };
  for (const Index v : flat.vertices) {
    Point p = state.vertices[v];
    p[cluster.axis] = 0;
    flat.state.vertices.push_back(p);
  }
  flat.state.input_vertices = flat.vertices.size();
  for (Index k = 0; k < cluster.facets.size(); ++k) {
    const Triangle& t = state.facets[cluster.facets[k]];
    flat.state.facets.push_back({number(t[0]), number(t[1]), number(t[2])});
    flat.state.facet_parents.add(std::array{k});
  }
  for (Index k = 0; k < flat.sides.size(); ++k) {
    flat.state.segments.push_back({number(flat.sides[k][0]), number(flat.sides[k][1])});
    flat.state.segment_parents.add(std::array{k});
  }
  return flat;
}

namespace {

using Edges = std::map<Index, std::set<Side>>;  // by facet of a cluster

/// The edges where the boundary of a facet's parts differs from the chains of its sides, modulo 2.
Edges odd_edges(const Cluster& cluster, const Flat& before, const State& after,
                std::span<const std::vector<Index>> chains) {
  std::vector<std::pair<Index, Side>> edges;
  const auto add = [&](Index k, Index a, Index b) {
    if (a != b) edges.emplace_back(k, ascending(Side{a, b}));
  };
  for (std::size_t f = 0; f < after.facets.size(); ++f)
    for (const Index k : after.facet_parents.of(f))
      for (std::size_t i = 0; i < 3; ++i) add(k, after.facets[f][i], after.facets[f][(i + 1) % 3]);
  for (Index k = 0; k < cluster.facets.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      const Triangle& t = before.state.facets[k];
      const Side side = ascending(Side{before.vertices[t[i]], before.vertices[t[(i + 1) % 3]]});
      const auto at = static_cast<std::size_t>(
          std::lower_bound(before.sides.begin(), before.sides.end(), side) - before.sides.begin());
      Index last = before.state.segments[at][0];
      for (const Index v : chains[at]) add(k, std::exchange(last, v), v);
      add(k, last, before.state.segments[at][1]);
    }
  std::sort(edges.begin(), edges.end());
  Edges odd;
  for (std::size_t k = 0, next = 0; k < edges.size(); k = next) {
    while (next < edges.size() && edges[next] == edges[k]) ++next;
    if ((next - k) % 2 != 0) odd[edges[k].first].insert(edges[k].second);
  }
  return odd;
}

/// Reassigns facets of the plane for a facet of the cluster: a facet that was not one of its parts becomes
/// one, and a part ceases to be one.
class Exchange {
 public:
  Exchange(const State& plane, Edges odd)
      : plane_(plane), odd_(std::move(odd)), changed_(plane.facets.size()) {}

  /// False if odd edges are left.
  bool run() {
    for (Index f = 0; f < plane_.facets.size(); ++f)
      for (auto& [k, edges] : odd_) {
        const std::array<Side, 3> sides = sides_of(f);
        if (std::all_of(sides.begin(), sides.end(), [&, &e = edges](const Side& s) { return e.contains(s); }))
          change({f}, k, edges);
      }
    if (is_done()) return true;
    for (Index f = 0; f < plane_.facets.size(); ++f)
      for (const Side& side : sides_of(f)) at_[side].push_back(f);
    for (auto& [k, edges] : odd_)
      while (!edges.empty())
        if (!change_within(k, edges)) return false;
    return true;
  }

  [[nodiscard]] std::set<Index> parents_of(Index f) const {
    const std::span<const Index> before = plane_.facet_parents.of(f);
    std::set<Index> parents(before.begin(), before.end());
    for (const Index k : changed_[f])
      if (parents.erase(k) == 0) parents.insert(k);
    return parents;
  }

 private:
  [[nodiscard]] bool is_done() const {
    return std::all_of(odd_.begin(), odd_.end(), [](const auto& of) { return of.second.empty(); });
  }

  [[nodiscard]] std::array<Side, 3> sides_of(Index f) const {
    const Triangle& t = plane_.facets[f];
    return {ascending(Side{t[0], t[1]}), ascending(Side{t[1], t[2]}), ascending(Side{t[2], t[0]})};
  }

  void change(const std::vector<Index>& facets, Index k, std::set<Side>& edges) {
    for (const Index f : facets) {
      changed_[f].push_back(k);
      for (const Side& side : sides_of(f))
        if (edges.erase(side) == 0) edges.insert(side);
    }
  }

  /// Reassigns what odd edges enclose: few facets, in a strip so thin that its sides were exchanged.
  bool change_within(Index k, std::set<Side>& edges) {
    for (const Side& edge : edges)
      for (const Index f : at_.at(edge))
        if (const std::vector<Index> facets = enclosed_with(f, edges); !facets.empty()) {
          const std::size_t before = edges.size();
          change(facets, k, edges);
          return edges.size() < before;
        }
    return false;
  }

  /// All facets that can be reached from one without crossing an odd edge; none if there are too many or they
  /// reach the border of the plane.
  [[nodiscard]] std::vector<Index> enclosed_with(Index start, const std::set<Side>& edges) const {
    constexpr std::size_t kMost = 256;
    std::vector<Index> facets{start};
    std::set<Index> seen{start};
    for (std::size_t i = 0; i < facets.size(); ++i)
      for (const Side& side : sides_of(facets[i])) {
        if (edges.contains(side)) continue;
        const std::vector<Index>& both = at_.at(side);
        if (both.size() != 2 || facets.size() > kMost) return {};
        const Index next = both[both[0] == facets[i] ? 1 : 0];
        if (seen.insert(next).second) facets.push_back(next);
      }
    return facets;
  }

  const State& plane_;
  Edges odd_;
  std::vector<std::vector<Index>> changed_;  // by facet of the plane, facets of the cluster
  std::map<Side, std::vector<Index>> at_;    // facets by side
};

}  // namespace

bool make_whole(const Cluster& cluster, const Flat& before, State& after,
                std::span<const std::vector<Index>> chains) {
  Edges odd = odd_edges(cluster, before, after, chains);
  if (odd.empty()) return true;
  Exchange exchange(after, std::move(odd));
  if (!exchange.run()) return false;
  std::vector<Triangle> facets;
  Parents parents;
  for (Index f = 0; f < after.facets.size(); ++f) {
    const std::set<Index> of = exchange.parents_of(f);
    if (of.empty()) continue;
    facets.push_back(after.facets[f]);
    parents.add(std::vector<Index>(of.begin(), of.end()));
  }
  after.facets = std::move(facets);
  after.facet_parents = std::move(parents);
  return true;
}

bool chain_of(const std::vector<Segment>& pieces, const Segment& side, std::vector<Index>& chain) {
  std::map<Index, std::vector<Index>> next;
  for (const auto& [a, b] : pieces) {
    if (a == b) continue;  // its ends have been joined
    next[a].push_back(b);
    next[b].push_back(a);
  }
  Index before = no_index, at = side[0];
  for (std::size_t steps = 0; at != side[1]; ++steps) {
    const auto found = next.find(at);
    if (found == next.end() || steps > pieces.size()) return false;
    const auto onward =
        std::find_if(found->second.begin(), found->second.end(), [&](Index v) { return v != before; });
    if (onward == found->second.end()) return false;
    before = at;
    at = *onward;
    if (at != side[1]) chain.push_back(at);
  }
  return true;
}

}  // namespace holdfast::repairing
