#include "repair/flatten.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "numbers/sorted.h"
#include "repair/clusters.h"
#include "repair/near.h"
#include "surface/complex.h"

namespace holdfast::repairing {
namespace {

using Side = std::array<Index, 2>;

/// How many gaps the sheets that are made of a cluster may be away from its facets.
constexpr double kMostGaps = 64;

class Flattening {
 public:
  Flattening(State& state, double gap, const RoundPlane& round)
      : state_(state), gap_(gap), round_(round), in_cluster_(state.facets.size(), 0) {}

  double run(const std::vector<Cluster>& clusters) {
    bool any = false;
    for (const Cluster& cluster : clusters) any |= arrange_cluster(cluster);
    if (!any) return 0;
    deliver();
    drop_unused(state_);
    return most_;
  }

 private:
  [[nodiscard]] const Point& at(Index v) const { return state_.vertices[v]; }

  /// The facets of a cluster in the plane, with their sides as segments.
  struct Flat {
    State state;
    std::vector<Index> vertices;  // of the state
    std::vector<Side> sides;      // ascending
  };

  [[nodiscard]] Flat flat(const Cluster& cluster) const {
    Flat flat;
    for (const Index f : cluster.facets) {
      const Triangle& t = state_.facets[f];
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
      Point p = at(v);
      p[cluster.axis] = 0;
      flat.state.vertices.push_back(p);
    }
    flat.state.input_vertices = flat.vertices.size();
    for (Index k = 0; k < cluster.facets.size(); ++k) {
      const Triangle& t = state_.facets[cluster.facets[k]];
      flat.state.facets.push_back({number(t[0]), number(t[1]), number(t[2])});
      flat.state.facet_parents.add(std::array{k});
    }
    for (Index k = 0; k < flat.sides.size(); ++k) {
      flat.state.segments.push_back({number(flat.sides[k][0]), number(flat.sides[k][1])});
      flat.state.segment_parents.add(std::array{k});
    }
    return flat;
  }

  bool arrange_cluster(const Cluster& cluster) {
    const Flat before = flat(cluster);
    if (std::any_of(before.sides.begin(), before.sides.end(),
                    [&](const Side& s) { return cut_.contains(s); }))
      return false;  // another cluster has cut it: in the next pass
    std::vector<Point> places(before.state.vertices);
    std::sort(places.begin(), places.end());
    if (std::adjacent_find(places.begin(), places.end()) != places.end()) return false;  // one above another
    const Rounded rounded = round_(before.state, kMostGaps * gap_);
    const State& after = rounded.state;
    if (!rounded.is_valid || !(rounded.displacement <= kMostGaps * gap_) ||
        !std::equal(before.state.vertices.begin(), before.state.vertices.end(), after.vertices.begin()))
      return false;
    // Every side must have become a chain from end to end.
    std::vector<std::vector<Segment>> pieces(before.sides.size());
    for (std::size_t s = 0; s < after.segments.size(); ++s)
      for (const Index p : after.segment_parents.of(s)) pieces[p].push_back(after.segments[s]);
    std::vector<std::vector<Index>> chains(before.sides.size());
    for (std::size_t k = 0; k < chains.size(); ++k)
      if (!chain_of(pieces[k], before.state.segments[k], chains[k]) ||
          (!chains[k].empty() && taken_.contains(before.sides[k])))
        return false;

    const std::size_t vertices = state_.vertices.size();
    std::vector<Index> name(after.vertices.size());
    for (Index v = 0; v < name.size(); ++v) {
      if (v < before.vertices.size()) {
        name[v] = before.vertices[v];
        continue;
      }
      name[v] = static_cast<Index>(state_.vertices.size());
      state_.vertices.push_back(after.vertices[v]);
      lifted_.insert(name[v]);
    }
    for (std::size_t f = 0; f < after.facets.size(); ++f) lift(cluster, after, f, name);
    for (const auto& [v, largest] : below_) {
      state_.vertices[v][cluster.axis] = above(largest.second, state_.vertices[v], cluster.axis);
      lifted_.erase(v);
    }
    below_.clear();
    if (!is_near(cluster, after, before, chains, name)) {
      lifted_.erase(lifted_.lower_bound(static_cast<Index>(vertices)), lifted_.end());
      state_.vertices.resize(vertices);
      return false;
    }
    taken_.insert(before.sides.begin(), before.sides.end());
    for (std::size_t f = 0; f < after.facets.size(); ++f) take(cluster, after, f, name);
    for (std::size_t k = 0; k < chains.size(); ++k)
      if (!chains[k].empty()) cut_side(cluster, before.sides[k], chains[k], name);
    for (const Index f : cluster.facets) in_cluster_[f] = 1;
    most_ = std::max(most_, rounded.displacement);
    return true;
  }

  /// Whether what comes of a cluster is near to it. Facets that stand steep on the plane are not, since their
  /// points come down on others far from them.
  [[nodiscard]] bool is_near(const Cluster& cluster, const State& after, const Flat& before,
                             std::span<const std::vector<Index>> chains, std::span<const Index> name) const {
    const double far = kMostGaps * gap_;
    for (std::size_t f = 0; f < after.facets.size(); ++f)
      for (const Index k : after.facet_parents.of(f))
        for (const Index v : after.facets[f])
          if (!(distance(name[v], state_.facets[cluster.facets[k]]) <= far)) return false;
    for (std::size_t k = 0; k < chains.size(); ++k)
      for (const Index v : chains[k])
        if (lifted_.count(name[v]) == 0 && !(distance(name[v], before.sides[k]) <= far)) return false;
    return true;
  }

  /// A side becomes a chain. What was on the facet that the side bounds only gets its third coordinate here.
  void cut_side(const Cluster& cluster, const Side& side, std::span<const Index> chain,
                std::span<const Index> name) {
    std::vector<Index>& cut = cut_[side];
    const Point &a = at(side[0]), &b = at(side[1]);
    for (const Index k : chain) {
      const Index v = name[k];
      cut.push_back(v);
      Point flat_a = a, flat_b = b, flat_v = at(v);
      flat_a[cluster.axis] = flat_b[cluster.axis] = flat_v[cluster.axis] = 0;
      const double share =
          std::clamp(length(minus(flat_v, flat_a)) / length(minus(flat_b, flat_a)), 0.0, 1.0);
      if (lifted_.erase(v) != 0)
        state_.vertices[v][cluster.axis] = a[cluster.axis] + share * (b[cluster.axis] - a[cluster.axis]);
      most_ = std::max(most_, distance(v, side));
    }
  }

  /// The vertices of a path between the ends of a side, without the ends; false where the pieces are none.
  static bool chain_of(const std::vector<Segment>& pieces, const Segment& side, std::vector<Index>& chain) {
    std::map<Index, std::vector<Index>> next;
    for (const auto& [a, b] : pieces) {
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

  /// Puts new corners onto the plane of the largest facet that they are a corner of a part of.
  void lift(const Cluster& cluster, const State& after, std::size_t f, std::span<const Index> name) {
    for (const Index v : after.facets[f]) {
      if (!lifted_.contains(name[v])) continue;
      for (const Index k : after.facet_parents.of(f)) {
        const Index parent = cluster.facets[k];
        const double size = length(normal_of(state_, parent));
        const auto [largest, is_new] = below_.try_emplace(name[v], size, parent);
        if (!is_new && largest->second.first < size) largest->second = {size, parent};
      }
    }
  }

  /// The coordinate along an axis at which the plane of a facet stands over a point, within its range.
  [[nodiscard]] double above(Index f, const Point& p, unsigned axis) const {
    const auto& [a, b, c] = state_.facets[f];
    const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
    const Vector u = minus(at(b), at(a)), v = minus(at(c), at(a)), w = minus(p, at(a));
    const double area = u[x] * v[y] - u[y] * v[x];
    const double s = (w[x] * v[y] - w[y] * v[x]) / area, t = (u[x] * w[y] - u[y] * w[x]) / area;
    const double z = at(a)[axis] + s * u[axis] + t * v[axis];
    const auto [low, high] = std::minmax({at(a)[axis], at(b)[axis], at(c)[axis]});
    return std::isfinite(z) ? std::clamp(z, low, high) : low;
  }

  /// Of a vertex and a side, rounded up.
  [[nodiscard]] double distance(Index v, const Side& side) const {
    const Point &a = at(side[0]), &b = at(side[1]);
    const double to_ends = std::min(length(minus(at(v), a)), length(minus(at(v), b))) * (1 + 0x1p-48);
    return std::min(beside_side(at(v), a, b).bound(), to_ends);
  }

  /// Of a vertex and a facet, rounded up.
  [[nodiscard]] double distance(Index v, const Triangle& t) const {
    if (v == t[0] || v == t[1] || v == t[2]) return 0;
    double least = beside_facet(at(v), at(t[0]), at(t[1]), at(t[2])).bound();
    for (std::size_t i = 0; i < 3; ++i) {
      least = std::min(least, beside_side(at(v), at(t[i]), at(t[(i + 1) % 3])).bound());
      least = std::min(least, length(minus(at(v), at(t[i]))) * (1 + 0x1p-48));
    }
    return least;
  }

  /// Takes a facet of the plane as one of the surface, with its parents there. How far its points are from a
  /// parent is a convex function: corners decide.
  void take(const Cluster& cluster, const State& after, std::size_t f, std::span<const Index> name) {
    const auto& [a, b, c] = after.facets[f];
    Piece piece{{name[a], name[b], name[c]}, {}};
    Index first = no_index;
    for (const Index k : after.facet_parents.of(f)) {
      const Index parent = cluster.facets[k];
      first = std::min(first, parent);
      const auto of = state_.facet_parents.of(parent);
      piece.parents.insert(piece.parents.end(), of.begin(), of.end());
      for (const Index v : piece.corners) most_ = std::max(most_, distance(v, state_.facets[parent]));
    }
    sort_unique(piece.parents);
    pieces_[first].push_back(std::move(piece));
  }

  /// All facets again: parts of clusters in the places of their first parents, others cut where their sides
  /// are.
  void deliver() {
    std::vector<Triangle> facets;
    Parents parents;
    std::vector<std::uint8_t> known;
    for (Index f = 0; f < in_cluster_.size(); ++f) {
      if (const auto found = pieces_.find(f); found != pieces_.end())
        for (const Piece& piece : found->second) {
          facets.push_back(piece.corners);
          parents.add(piece.parents);
          known.push_back(0);
        }
      if (in_cluster_[f] != 0) continue;
      const std::vector<Triangle> parts = cut(state_.facets[f]);
      for (const Triangle& t : parts) {
        facets.push_back(t);
        parents.add(state_.facet_parents.of(f));
        known.push_back(parts.size() > 1 || state_.known.empty() ? 0 : state_.known[f]);
      }
    }
    state_.facets = std::move(facets);
    state_.facet_parents = std::move(parents);
    if (!state_.known.empty()) state_.known = std::move(known);
    state_.sheet.clear();
    deliver_segments();
  }

  void deliver_segments() {
    std::vector<Segment> segments;
    Parents parents;
    for (std::size_t s = 0; s < state_.segments.size(); ++s) {
      Index before = state_.segments[s][0];
      for (const Index v : chain_from(state_.segments[s][0], state_.segments[s][1])) {
        segments.push_back({before, v});
        parents.add(state_.segment_parents.of(s));
        before = v;
      }
      segments.push_back({before, state_.segments[s][1]});
      parents.add(state_.segment_parents.of(s));
    }
    state_.segments = std::move(segments);
    state_.segment_parents = std::move(parents);
  }

  [[nodiscard]] std::vector<Index> chain_from(Index a, Index b) const {
    const auto found = cut_.find(ascending(Side{a, b}));
    if (found == cut_.end()) return {};
    std::vector<Index> chain = found->second;
    if (a > b) std::reverse(chain.begin(), chain.end());
    return chain;
  }

  /// One side after the other: each fan leaves the other two sides whole.
  [[nodiscard]] std::vector<Triangle> cut(const Triangle& facet) const {
    std::vector<Triangle> parts{facet};
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = facet[i], b = facet[(i + 1) % 3];
      const std::vector<Index> chain = chain_from(a, b);
      if (chain.empty()) continue;
      std::vector<Triangle> now;
      for (const Triangle& t : parts) {
        const auto at_a = static_cast<std::size_t>(std::find(t.begin(), t.end(), a) - t.begin());
        if (at_a == 3 || t[(at_a + 1) % 3] != b) {
          now.push_back(t);
          continue;
        }
        const Index apex = t[(at_a + 2) % 3];
        Index before = a;
        for (const Index v : chain) {
          if (v != apex) now.push_back({before, v, apex});
          before = v;
        }
        now.push_back({before, b, apex});
      }
      parts = std::move(now);
    }
    std::erase_if(parts, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    return parts;
  }

  struct Piece {
    Triangle corners;
    std::vector<Index> parents;
  };

  State& state_;
  const double gap_;
  const RoundPlane& round_;
  std::vector<std::uint8_t> in_cluster_;             // by facet
  std::map<Index, std::vector<Piece>> pieces_;       // by first facet
  std::set<Side> taken_;                             // of clusters that were arranged
  std::map<Side, std::vector<Index>> cut_;           // by side, ascending: what it is led through
  std::set<Index> lifted_;                           // new vertices that have no third coordinate yet
  std::map<Index, std::pair<double, Index>> below_;  // of these, the area and the index of the largest facet
  double most_ = 0;
};

}  // namespace

double flatten(State& state, double gap, const RoundPlane& round, const Step& step,
               std::span<const Index> some) {
  return Flattening(state, gap, round).run(find_clusters(state, gap, some, step));
}

}  // namespace holdfast::repairing
