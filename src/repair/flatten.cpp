#include "repair/flatten.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "numbers/sorted.h"
#include "repair/bounds.h"
#include "repair/flat_cluster.h"
#include "repair/near.h"
#include "repair/plans.h"
#include "repair/shared_sides.h"
#include "repair/sheet_parts.h"
#include "surface/complex.h"

namespace holdfast::repairing {
namespace {

/// Largest distance, in gaps, between the sheets made of a cluster and the cluster's facets.
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
        in_sheets_{std::vector<std::uint8_t>(state.facets.size(), 0),
                   std::vector<std::uint8_t>(state.facets.size(), 0)} {}

  Flattened run(const Clusters& clusters) {
    bool any = false;
    for (const Cluster& cluster : clusters.all) any |= arrange_cluster(cluster);
    if (!any && !sides_.has_united()) return {};
    if (!sides_.finish()) {
      state_.vertices.resize(vertices_);
      return {0, has_shared_, {}};
    }
    for (const Index f : clusters.facets) in_sheets_.overlap[f] = 1;
    Delivered delivered = deliver_sheets(state_, sides_, parts_, in_sheets_);
    drop_unused(state_);
    return {std::max({most_, sides_.most(), delivered.moved}), has_shared_, std::move(delivered.changed)};
  }

 private:
  [[nodiscard]] const Point& at(Index v) const { return state_.vertices[v]; }

  /// A cluster after it was arranged in its plane.
  struct Sheet {
    State state;
    double moved = 0;
    std::vector<std::vector<Index>> chains;  // the vertices on each side, without its ends
  };

  bool arrange_cluster(const Cluster& cluster) {
    const Flat before = flat_of(state_, cluster);
    if (is_led(before) && waits()) return false;
    if (has_one_above_another(before)) return false;
    std::optional<Sheet> sheet = rounded(cluster, before);
    if (!sheet || (leads_what_is_told(before, *sheet) && waits())) return false;

    const std::size_t vertices = state_.vertices.size();
    const std::vector<Index> name = put_vertices(before, sheet->state);
    lift_all(cluster, sheet->state, name);
    const Corners corners = corners_of_parts(sheet->state);
    if (!is_near(cluster, corners, before, sheet->chains, name) ||
        !put_on_sides(cluster, before, *sheet, name)) {
      lifted_.erase(lifted_.lower_bound(static_cast<Index>(vertices)), lifted_.end());
      state_.vertices.resize(vertices);
      return false;
    }
    take(cluster, before, *sheet, name);
    // The distance of a part's points from its parent is a convex function, so the corners decide.
    for (const auto& [k, v] : corners)
      most_ = std::max(most_, distance(name[v], state_.facets[cluster.facets[k]]));
    return true;
  }

  /// Whether a sheet that shares a led side waits for the next call.
  [[nodiscard]] bool waits() {
    has_shared_ = true;
    return sides_of_ == SidesOf::one_sheet;
  }

  /// Whether another sheet leads a side.
  [[nodiscard]] bool is_led(const Flat& flat) const {
    return std::any_of(flat.sides.begin(), flat.sides.end(),
                       [&](const Side& s) { return !sides_.chain(s[0], s[1]).empty(); });
  }

  /// The cluster, arranged in its plane and rounded. Nothing if that moves it too far, tears a facet, or
  /// leaves a side that is not a chain from end to end.
  [[nodiscard]] std::optional<Sheet> rounded(const Cluster& cluster, const Flat& before) const {
    Rounded in_plane = round_(before.state, kMostGaps * gap_);
    State& after = in_plane.state;
    if (!in_plane.is_valid || !(in_plane.displacement <= kMostGaps * gap_) ||
        !std::equal(before.state.vertices.begin(), before.state.vertices.end(), after.vertices.begin()))
      return std::nullopt;
    std::vector<std::vector<Segment>> pieces(before.sides.size());
    for (std::size_t s = 0; s < after.segments.size(); ++s)
      for (const Index p : after.segment_parents.of(s)) pieces[p].push_back(after.segments[s]);
    std::vector<std::vector<Index>> chains(before.sides.size());
    for (std::size_t k = 0; k < chains.size(); ++k)
      if (!chain_of(pieces[k], before.state.segments[k], chains[k])) return std::nullopt;
    if (!make_whole(cluster, before, after, chains)) return std::nullopt;
    return Sheet{std::move(after), in_plane.displacement, std::move(chains)};
  }

  [[nodiscard]] bool leads_what_is_told(const Flat& before, const Sheet& sheet) const {
    for (std::size_t k = 0; k < sheet.chains.size(); ++k)
      if (!sheet.chains[k].empty() && sides_.is_told(before.sides[k])) return true;
    return false;
  }

  /// Adds the new vertices of a sheet to the state, still without a third coordinate. Returns the state's
  /// index of each vertex.
  std::vector<Index> put_vertices(const Flat& before, const State& sheet) {
    std::vector<Index> name = before.vertices;
    for (std::size_t v = name.size(); v < sheet.vertices.size(); ++v) {
      name.push_back(static_cast<Index>(state_.vertices.size()));
      state_.vertices.push_back(sheet.vertices[v]);
      lifted_.insert(name.back());
    }
    return name;
  }

  /// Gives new vertices that are corners of facets their third coordinate. The other new vertices are on
  /// sides alone.
  void lift_all(const Cluster& cluster, const State& sheet, std::span<const Index> name) {
    for (std::size_t f = 0; f < sheet.facets.size(); ++f) lift(cluster, sheet, f, name);
    for (const auto& [v, largest] : below_) {
      state_.vertices[v][cluster.axis] = above(largest.second, state_.vertices[v], cluster.axis);
      lifted_.erase(v);
    }
    below_.clear();
  }

  /// Renames the chains of a sheet to the state's vertices. False if a chain contradicts the vertices through
  /// which other sheets lead the side.
  bool put_on_sides(const Cluster& cluster, const Flat& before, Sheet& sheet, std::span<const Index> name) {
    for (std::size_t k = 0; k < sheet.chains.size(); ++k)
      if (!sheet.chains[k].empty()) put_on_side(cluster, before.sides[k], sheet.chains[k], name);
    for (std::vector<Index>& chain : sheet.chains)
      for (Index& v : chain) v = name[v];
    for (std::size_t k = 0; k < sheet.chains.size(); ++k)
      if (!sides_.fits(before.sides[k][0], before.sides[k][1], sheet.chains[k])) return false;
    return true;
  }

  void take(const Cluster& cluster, const Flat& before, const Sheet& sheet, std::span<const Index> name) {
    for (std::size_t f = 0; f < sheet.state.facets.size(); ++f) take(cluster, sheet.state, f, name);
    ++sheets_;
    for (std::size_t k = 0; k < sheet.chains.size(); ++k)
      sides_.add(before.sides[k][0], before.sides[k][1], sheet.chains[k]);
    for (const Index f : cluster.facets) in_sheets_.are_parted[f] = 1;
    most_ = std::max(most_, sheet.moved);
  }

  [[nodiscard]] static Index sheets_of(const State& state) {
    Index next = 0;
    for (const Index sheet : state.sheet)
      if (sheet != no_index) next = std::max(next, sheet + 1);
    return next;
  }

  /// Whether two vertices of the cluster stand above each other. If they are at most the gap apart, the later
  /// one, if new, becomes the other for the next pass: they are one point of several planes, and each plane
  /// has added its own.
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
      if (length(at(v) - at(w)) <= gap_) sides_.unite(v, w, state_.input_vertices);
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

  /// Whether the arranged cluster lies near the given one. It does not if a facet is steep on the plane,
  /// because points of such a facet land on other facets far away.
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

  /// A vertex that no facet gave a third coordinate gets it from the side that it is on.
  void put_on_side(const Cluster& cluster, const Side& side, std::span<const Index> chain,
                   std::span<const Index> name) {
    const Point &a = at(side[0]), &b = at(side[1]);
    for (const Index k : chain) {
      const Index v = name[k];
      Point flat_a = a, flat_b = b, flat_v = at(v);
      flat_a[cluster.axis] = flat_b[cluster.axis] = flat_v[cluster.axis] = 0;
      const double share = std::clamp(length(flat_v - flat_a) / length(flat_b - flat_a), 0.0, 1.0);
      if (lifted_.erase(v) != 0)
        state_.vertices[v][cluster.axis] = a[cluster.axis] + share * (b[cluster.axis] - a[cluster.axis]);
      most_ = std::max(most_, distance(v, side));
    }
  }

  /// Puts each new corner on the plane of the largest facet that has a part with this corner.
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

  /// The coordinate along an axis of the facet's plane over a point, clamped to the range of the facet.
  [[nodiscard]] double above(Index f, const Point& p, unsigned axis) const {
    const auto& [a, b, c] = state_.facets[f];
    const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
    const Vector u = at(b) - at(a), v = at(c) - at(a), w = p - at(a);
    const double area = u[x] * v[y] - u[y] * v[x];
    const double s = (w[x] * v[y] - w[y] * v[x]) / area, t = (u[x] * w[y] - u[y] * w[x]) / area;
    const double z = at(a)[axis] + s * u[axis] + t * v[axis];
    const auto [low, high] = std::minmax({at(a)[axis], at(b)[axis], at(c)[axis]});
    return std::isfinite(z) ? std::clamp(z, low, high) : low;
  }

  [[nodiscard]] double distance(Index v, const Side& side) const {
    return distance_above(at(v), at(side[0]), at(side[1]));
  }
  [[nodiscard]] double distance(Index v, const Triangle& t) const {
    return distance_above(at(v), at(t[0]), at(t[1]), at(t[2]));
  }

  /// Adds a facet of the plane to the surface, with its parents there.
  void take(const Cluster& cluster, const State& after, std::size_t f, std::span<const Index> name) {
    const auto& [a, b, c] = after.facets[f];
    SheetPart part{{name[a], name[b], name[c]}, {}, {}, sheets_};
    Index first = no_index;
    for (const Index k : after.facet_parents.of(f)) {
      const Index parent = cluster.facets[k];
      first = std::min(first, parent);
      part.facets.push_back(parent);
      const auto of = state_.facet_parents.of(parent);
      part.parents.insert(part.parents.end(), of.begin(), of.end());
    }
    sort_odd(part.parents);
    parts_[first].push_back(std::move(part));
  }

  State& state_;
  const double gap_;
  const RoundPlane& round_;
  const std::size_t vertices_;  // before
  const SidesOf sides_of_;
  SharedSides sides_;
  Index sheets_;  // the next number for `State::sheet`
  InSheets in_sheets_;
  SheetParts parts_;
  std::set<Index> lifted_;                           // new vertices that have no third coordinate yet
  std::map<Index, std::pair<double, Index>> below_;  // of these, the area and the index of the largest facet
  double most_ = 0;
  bool has_shared_ = false;
};

}  // namespace

Flattened flatten(State& state, double gap, const RoundPlane& round, SidesOf sides, const Step& step,
                  std::span<const Index> some) {
  return Flattening(state, gap, round, sides).run(find_clusters(state, gap, some, step));
}

Flattened flatten_all(State& state, double gap, const RoundPlane& round, SidesOf sides, const Step& step) {
  return flatten_all(state, find_clusters(state, gap, {}, step), gap, round, sides, step);
}

Flattened flatten_all(State& state, const Clusters& clusters, double gap, const RoundPlane& round,
                      SidesOf sides, const Step& step) {
  constexpr int kPasses = 4;  // flattening one cluster may bring others near
  Flattened all = Flattening(state, gap, round, sides).run(clusters);
  std::vector<Index> some = std::move(all.changed);
  for (int pass = 1; pass < kPasses && all.moved > 0 && !some.empty(); ++pass) {
    const Clusters again = find_clusters(state, gap, some, step);
    // Where much lies within the gap, parts of sheets overlap others anew, and more of them in each pass.
    if (again.facets.size() > most_in_later_passes(clusters.facets.size())) break;
    Flattened now = Flattening(state, gap, round, sides).run(again);
    all.has_shared |= now.has_shared;
    if (now.moved == 0) break;
    all.moved = sum_above(all.moved, now.moved);
    some = std::move(now.changed);
  }
  all.changed.clear();
  return all;
}

}  // namespace holdfast::repairing
