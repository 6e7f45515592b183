#include "repair/flatten.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "arrange/index_table.h"
#include "numbers/sorted.h"
#include "repair/bounds.h"
#include "repair/clusters.h"
#include "repair/flat_cluster.h"
#include "repair/near.h"
#include "repair/shared_sides.h"
#include "surface/complex.h"

namespace holdfast::repairing {
namespace {

/// How many gaps the sheets that are made of a cluster may be away from its facets.
constexpr double kMostGaps = 64;

class Flattening {
 public:
  Flattening(State& state, double gap, const RoundPlane& round, SidesOf sides)
      : state_(state),
        gap_(gap),
        round_(round),
        vertices_(state.vertices.size()),
        sides_of_(sides),
        sides_(state.vertices, gap),
        sheets_(sheets_of(state)),
        in_cluster_(state.facets.size(), 0),
        overlaps_(state.facets.size(), 0) {}

  Flattened run(const Clusters& clusters) {
    bool any = false;
    for (const Cluster& cluster : clusters.all) any |= arrange_cluster(cluster);
    if (!any && !sides_.has_united()) return {};
    if (!sides_.finish()) {
      state_.vertices.resize(vertices_);
      return {0, has_led_, {}};
    }
    for (const Index f : clusters.facets) overlaps_[f] = 1;
    deliver();
    drop_unused(state_);
    return {std::max(most_, sides_.most()), has_led_, std::move(changed_)};
  }

 private:
  [[nodiscard]] const Point& at(Index v) const { return state_.vertices[v]; }

  bool arrange_cluster(const Cluster& cluster) {
    const Flat before = flat_of(state_, cluster);
    const bool waits = sides_of_ == SidesOf::one_sheet;
    if (waits && std::any_of(before.sides.begin(), before.sides.end(),
                             [&](const Side& s) { return !sides_.chain(s[0], s[1]).empty(); }))
      return false;
    if (has_one_above_another(before)) return false;
    Rounded rounded = round_(before.state, kMostGaps * gap_);
    State& after = rounded.state;
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
          (waits && !chains[k].empty() && sides_.is_told(before.sides[k])))
        return false;
    if (!make_whole(cluster, before, after, chains)) return false;

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
    const auto undo = [&] {
      lifted_.erase(lifted_.lower_bound(static_cast<Index>(vertices)), lifted_.end());
      state_.vertices.resize(vertices);
      return false;
    };
    const Corners corners = corners_of_parts(after);
    if (!is_near(cluster, corners, before, chains, name)) return undo();
    for (std::size_t k = 0; k < chains.size(); ++k)
      if (!chains[k].empty()) put_on_side(cluster, before.sides[k], chains[k], name);
    for (std::vector<Index>& chain : chains)
      for (Index& v : chain) v = name[v];
    for (std::size_t k = 0; k < chains.size(); ++k)
      if (!sides_.fits(before.sides[k][0], before.sides[k][1], chains[k])) return undo();
    for (std::size_t f = 0; f < after.facets.size(); ++f) take(cluster, after, f, name);
    ++sheets_;
    // How far the points of a part are from its parent is a convex function: corners decide.
    for (const auto& [k, v] : corners)
      most_ = std::max(most_, distance(name[v], state_.facets[cluster.facets[k]]));
    for (std::size_t k = 0; k < chains.size(); ++k) {
      sides_.add(before.sides[k][0], before.sides[k][1], chains[k]);
      has_led_ |= !chains[k].empty();
    }
    for (const Index f : cluster.facets) in_cluster_[f] = 1;
    most_ = std::max(most_, rounded.displacement);
    return true;
  }

  [[nodiscard]] static Index sheets_of(const State& state) {
    Index next = 0;
    for (const Index sheet : state.sheet)
      if (sheet != no_index) next = std::max(next, sheet + 1);
    return next;
  }

  /// New vertices that stand above another one become it, if they are no more than the gap away: for the next
  /// pass. They are points of several planes, of which each has put its own there.
  bool has_one_above_another(const Flat& flat) {
    std::vector<std::pair<Point, Index>> places;
    for (std::size_t k = 0; k < flat.vertices.size(); ++k)
      places.emplace_back(flat.state.vertices[k], flat.vertices[k]);
    std::sort(places.begin(), places.end());
    bool any = false;
    Index first = 0;  // at the place
    for (std::size_t k = 1; k < places.size(); ++k) {
      if (places[k].first != places[first].first) {
        first = static_cast<Index>(k);
        continue;
      }
      any = true;
      const Index v = places[first].second, w = places[k].second;
      if (length(minus(at(v), at(w))) <= gap_) sides_.unite(v, w, state_.input_vertices);
    }
    return any;
  }

  /// Facets of a cluster, by number there, and the corners of their parts.
  using Corners = std::vector<std::array<Index, 2>>;
  [[nodiscard]] static Corners corners_of_parts(const State& after) {
    Corners corners;
    for (std::size_t f = 0; f < after.facets.size(); ++f)
      for (const Index k : after.facet_parents.of(f))
        for (const Index v : after.facets[f]) corners.push_back({k, v});
    sort_unique(corners);
    return corners;
  }

  /// Whether what comes of a cluster is near to it. Facets that stand steep on the plane are not, since their
  /// points come down on others far from them.
  [[nodiscard]] bool is_near(const Cluster& cluster, const Corners& corners, const Flat& before,
                             std::span<const std::vector<Index>> chains, std::span<const Index> name) const {
    const double far = kMostGaps * gap_;
    for (const auto& [k, v] : corners)
      if (!(distance(name[v], state_.facets[cluster.facets[k]]) <= far)) return false;
    for (std::size_t k = 0; k < chains.size(); ++k)
      for (const Index v : chains[k])
        if (lifted_.count(name[v]) == 0 && !(distance(name[v], before.sides[k]) <= far)) return false;
    return true;
  }

  /// What was on the facet that a side bounds only gets its third coordinate where it is on the side.
  void put_on_side(const Cluster& cluster, const Side& side, std::span<const Index> chain,
                   std::span<const Index> name) {
    const Point &a = at(side[0]), &b = at(side[1]);
    for (const Index k : chain) {
      const Index v = name[k];
      Point flat_a = a, flat_b = b, flat_v = at(v);
      flat_a[cluster.axis] = flat_b[cluster.axis] = flat_v[cluster.axis] = 0;
      const double share =
          std::clamp(length(minus(flat_v, flat_a)) / length(minus(flat_b, flat_a)), 0.0, 1.0);
      if (lifted_.erase(v) != 0)
        state_.vertices[v][cluster.axis] = a[cluster.axis] + share * (b[cluster.axis] - a[cluster.axis]);
      most_ = std::max(most_, distance(v, side));
    }
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

  /// Takes a facet of the plane as one of the surface, with its parents there.
  void take(const Cluster& cluster, const State& after, std::size_t f, std::span<const Index> name) {
    const auto& [a, b, c] = after.facets[f];
    Piece piece{{name[a], name[b], name[c]}, {}, {}, sheets_};
    Index first = no_index;
    for (const Index k : after.facet_parents.of(f)) {
      const Index parent = cluster.facets[k];
      first = std::min(first, parent);
      piece.facets.push_back(parent);
      const auto of = state_.facet_parents.of(parent);
      piece.parents.insert(piece.parents.end(), of.begin(), of.end());
    }
    sort_odd(piece.parents);
    pieces_[first].push_back(std::move(piece));
  }

  /// All facets again: parts of clusters in the places of their first parents, others cut where their sides
  /// are.
  void deliver() {
    std::vector<Triangle> facets;
    Parents parents;
    std::vector<std::uint8_t> known, changed;
    std::vector<Index> sheet;
    for (Index f = 0; f < in_cluster_.size(); ++f) {
      if (const auto found = pieces_.find(f); found != pieces_.end())
        for (Piece& piece : found->second) {
          const std::vector<Triangle> parts = cut(piece.corners);
          const bool is_whole = parts.size() == 1 && parts[0] == piece.corners;
          for (const Triangle& t : parts) {
            facets.push_back(t);
            parents.add(piece.parents);
            known.push_back(0);
            sheet.push_back(is_whole ? piece.sheet : no_index);
            changed.push_back(1);
            if (is_whole) continue;
            for (const Index parent : piece.facets)
              for (const Index v : t) most_ = std::max(most_, distance(v, state_.facets[parent]));
          }
        }
      if (in_cluster_[f] != 0) continue;
      const auto add = [&](const Triangle& t) {
        facets.push_back(t);
        parents.add(state_.facet_parents.of(f));
        known.push_back(t != state_.facets[f] || state_.known.empty() ? 0 : state_.known[f]);
        sheet.push_back(t != state_.facets[f] || state_.sheet.empty() ? no_index : state_.sheet[f]);
        changed.push_back(t != state_.facets[f] ? 1 : overlaps_[f]);
      };
      if (stays_whole(state_.facets[f]))
        add(state_.facets[f]);
      else
        for (const Triangle& t : cut(state_.facets[f])) add(t);
    }
    if (state_.known.empty()) known.clear();
    deliver_facets(facets, parents, known, sheet, changed);
    deliver_segments();
  }

  /// Facets with the same corners are one, whose parents are those of which they are an odd number of parts:
  /// a sheet that was folded would end at its folds else.
  void deliver_facets(std::span<const Triangle> facets, const Parents& parents,
                      std::span<const std::uint8_t> known, std::span<const Index> sheet,
                      std::span<const std::uint8_t> changed) {
    arrange::IndexTable<3> first_with;
    std::vector<std::uint8_t> is_first(facets.size(), 0);
    std::map<Index, std::vector<Index>> of_several;  // by the first of them, their parents
    for (Index f = 0; f < facets.size(); ++f) {
      const Index first = first_with.find_or_add(ascending(facets[f]), f);
      is_first[f] = first == f ? 1 : 0;
      if (first == f) continue;
      const auto [found, is_new] = of_several.try_emplace(first);
      std::vector<Index>& list = found->second;
      if (is_new) list.assign(parents.of(first).begin(), parents.of(first).end());
      list.insert(list.end(), parents.of(f).begin(), parents.of(f).end());
    }
    state_.facets.clear();
    state_.facet_parents = {};
    state_.known.clear();
    state_.sheet.clear();
    for (Index f = 0; f < facets.size(); ++f) {
      if (is_first[f] == 0) continue;
      std::span<const Index> list = parents.of(f);
      if (const auto found = of_several.find(f); found != of_several.end()) {
        sort_odd(found->second);
        list = found->second;
      }
      if (list.empty()) continue;
      if (changed[f] != 0 || of_several.contains(f))
        changed_.push_back(static_cast<Index>(state_.facets.size()));
      state_.facets.push_back(facets[f]);
      state_.facet_parents.add(list);
      if (!known.empty()) state_.known.push_back(known[f]);
      state_.sheet.push_back(sheet[f]);
    }
  }

  void deliver_segments() {
    std::vector<Segment> segments;
    Parents parents;
    for (std::size_t s = 0; s < state_.segments.size(); ++s) {
      const Index end = sides_.root(state_.segments[s][1]);
      Index before = sides_.root(state_.segments[s][0]);
      std::vector<Index> chain = sides_.chain(before, end);
      chain.push_back(end);
      for (const Index v : chain) {
        if (before == v) continue;
        segments.push_back({before, v});
        parents.add(state_.segment_parents.of(s));
        before = v;
      }
    }
    state_.segments = std::move(segments);
    state_.segment_parents = std::move(parents);
  }

  [[nodiscard]] bool stays_whole(const Triangle& t) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3];
      if (a == b || sides_.root(a) != a || sides_.is_led(a, b)) return false;
    }
    return true;
  }

  /// One side after the other: each fan leaves the other two sides whole.
  [[nodiscard]] std::vector<Triangle> cut(Triangle facet) const {
    for (Index& v : facet) v = sides_.root(v);
    std::vector<Triangle> parts{facet};
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = facet[i], b = facet[(i + 1) % 3];
      const std::vector<Index> chain = sides_.chain(a, b);
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
    std::vector<Index> facets;  // of the state, that it is a part of
    Index sheet;
  };

  State& state_;
  const double gap_;
  const RoundPlane& round_;
  const std::size_t vertices_;  // before
  const SidesOf sides_of_;
  SharedSides sides_;
  Index sheets_;                                     // the next number for `State::sheet`
  std::vector<std::uint8_t> in_cluster_, overlaps_;  // by facet
  std::vector<Index> changed_;                       // or overlapped others, as they are in the end
  std::map<Index, std::vector<Piece>> pieces_;       // by first facet
  std::set<Index> lifted_;                           // new vertices that have no third coordinate yet
  std::map<Index, std::pair<double, Index>> below_;  // of these, the area and the index of the largest facet
  double most_ = 0;
  bool has_led_ = false;
};

}  // namespace

Flattened flatten(State& state, double gap, const RoundPlane& round, SidesOf sides, const Step& step,
                  std::span<const Index> some) {
  return Flattening(state, gap, round, sides).run(find_clusters(state, gap, some, step));
}

Flattened flatten_all(State& state, double gap, const RoundPlane& round, SidesOf sides, const Step& step) {
  constexpr int kPasses = 4;
  Flattened all;
  std::vector<Index> some;
  for (int pass = 0; pass < kPasses; ++pass) {
    Flattened now = flatten(state, gap, round, sides, step, some);
    all.has_led |= now.has_led;
    if (now.moved == 0) break;
    all.moved = sum_above(all.moved, now.moved);
    if (now.changed.empty()) break;
    some = std::move(now.changed);
  }
  return all;
}

}  // namespace holdfast::repairing
