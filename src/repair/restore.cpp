#include "repair/restore.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "numbers/sorted.h"
#include "repair/near.h"
#include "surface/aabb_tree.h"
#include "surface/complex.h"
#include "surface/elements.h"

namespace holdfast::repairing {
namespace {

using Side = std::array<Index, 2>;

/// A change that inserts a vertex: the facets and segments to remove, and their replacements.
struct Change {
  struct Part {
    Triangle corners;
    Index from;  // the facet that it replaces
  };
  Index vertex;
  std::vector<Index> facets;
  std::vector<Part> parts;
  std::optional<Side> side;       // ascending: segments along it are led through the vertex
  double distance = 0, bent = 0;  // of the vertex from the removed facets, and the same rounded up
};

class Restoring {
 public:
  Restoring(State& state, std::span<const Point> before, const Step& step, const Threads& threads)
      : state_(state), before_(before), step_(step), threads_(threads) {}

  double run() {
    list_lost();
    if (lost_.empty() || is_there_twice()) return 0;
    state_.doubt_all();
    bent_.assign(state_.facets.size(), 0);
    constexpr int kMostRounds = 64;
    for (int round = 0; round < kMostRounds && !lost_.empty(); ++round)
      if (!take_round()) break;
    state_.doubt_all();
    return most_;
  }

 private:
  /// A lost vertex, and others that were at its place.
  struct Lost {
    Index vertex;
    std::vector<Index> same;
    std::set<std::vector<Index>> tried;  // by the corners of the new facets
  };

  void list_lost() {
    std::set<Point> places;
    std::vector<Index> gone;
    for (Index v = 0; v < state_.input_vertices; ++v)
      if (before_[v] != state_.vertices[v] && is_finite(before_[v])) {
        gone.push_back(v);
        places.insert(before_[v]);
      }
    if (gone.empty()) return;
    std::set<Point> taken;
    const auto take = [&](Index v) {
      if (const auto at = places.find(state_.vertices[v]); at != places.end()) taken.insert(*at);
    };
    for (const Triangle& t : state_.facets) std::for_each(t.begin(), t.end(), take);
    for (const Segment& s : state_.segments) std::for_each(s.begin(), s.end(), take);
    std::map<Point, std::size_t> number;
    for (const Index v : gone) {
      const Point& p = before_[v];
      if (taken.count(p) != 0) {
        state_.vertices[v] = p;
        continue;
      }
      const auto [at, is_new] = number.try_emplace(p, lost_.size());
      if (is_new)
        lost_.push_back({v, {}, {}});
      else
        lost_[at->second].same.push_back(v);
    }
  }

  /// Two sheets without a double between them are one sheet. With the vertices of both, the surface would be
  /// full of sides as long as a few last bits, and elements beside them could not be computed with.
  [[nodiscard]] bool is_there_twice() const {
    constexpr std::size_t kShare = 4;
    std::size_t count = 0;
    for (const Lost& lost : lost_) count += 1 + lost.same.size();
    return kShare * count > state_.input_vertices;
  }

  [[nodiscard]] const Point& at(Index v) const { return state_.vertices[v]; }

  /// Picks at most one change a vertex, so that no two have a facet in common, and makes those that fit.
  /// False if none is left to try.
  bool take_round() {
    const std::vector<std::vector<Index>> near = facets_near_lost();
    std::vector<Change> changes;
    std::vector<std::uint8_t> is_used(state_.facets.size(), 0);
    bool any = false;
    for (std::size_t k = 0; k < lost_.size(); ++k) {
      std::optional<Change> change = next_change(lost_[k], near[k]);
      if (!change) continue;
      any = true;
      if (std::any_of(change->facets.begin(), change->facets.end(), [&](Index f) { return is_used[f] != 0; }))
        continue;
      for (const Index f : change->facets) is_used[f] = 1;
      changes.push_back(std::move(*change));
    }
    make(std::move(changes));
    return any;
  }

  /// The distance within which facets may be changed for a lost vertex.
  [[nodiscard]] double reach(const Lost& lost) const {
    constexpr double kWider = 2;
    return kWider * length(before_[lost.vertex] - at(lost.vertex));
  }

  /// For each lost vertex the facets within its reach, ascending. A tree of the few vertices is built sooner
  /// than one of all facets.
  [[nodiscard]] std::vector<std::vector<Index>> facets_near_lost() const {
    std::vector<Box> boxes;
    for (const Lost& lost : lost_) {
      const Point& p = before_[lost.vertex];
      const double far = reach(lost);
      boxes.push_back({{p[0] - far, p[1] - far, p[2] - far}, {p[0] + far, p[1] + far, p[2] + far}});
    }
    const AabbTree tree(boxes);
    std::vector<std::vector<Index>> near(lost_.size());
    for (Index f = 0; f < state_.facets.size(); ++f) {
      const Box box = box_round(state_, state_.facets[f], 0);
      tree.for_each_item([&](const Box& other) { return !box.overlaps(other); },
                         [&](const AabbTree::Item& item) { near[item.id].push_back(f); });
    }
    return near;
  }

  [[nodiscard]] static std::vector<Index> key_of(const Change& change) {
    std::vector<Index> key;
    for (const Change::Part& part : change.parts)
      key.insert(key.end(), part.corners.begin(), part.corners.end());
    return key;
  }

  std::optional<Change> next_change(const Lost& lost, std::span<const Index> near) const {
    for (Change& change : changes_for(lost, near))
      if (lost.tried.count(key_of(change)) == 0) return std::move(change);
    return std::nullopt;
  }

  /// The nearest comes first.
  [[nodiscard]] std::vector<Change> changes_for(const Lost& lost, std::span<const Index> near) const {
    const double far = reach(lost);
    std::vector<Change> changes;
    for (const Index f : near)
      if (std::optional<Change> change = through_facet(lost.vertex, f); change && change->distance <= far)
        changes.push_back(std::move(*change));
    for (const Side& side : sides_of(near))
      if (std::optional<Change> change = through_side(lost.vertex, side, near);
          change && change->distance <= far)
        changes.push_back(std::move(*change));
    const std::size_t beside = changes.size();
    through_star(lost.vertex, near, changes);
    constexpr auto is_nearer = [](const Change& a, const Change& b) { return a.distance < b.distance; };
    std::stable_sort(changes.begin(), changes.begin() + static_cast<std::ptrdiff_t>(beside), is_nearer);
    std::stable_sort(changes.begin() + static_cast<std::ptrdiff_t>(beside), changes.end(), is_nearer);
    return changes;
  }

  [[nodiscard]] std::vector<Side> sides_of(std::span<const Index> facets) const {
    std::vector<Side> sides;
    for (const Index f : facets)
      for (std::size_t i = 0; i < 3; ++i)
        sides.push_back(ascending(Side{state_.facets[f][i], state_.facets[f][(i + 1) % 3]}));
    sort_unique(sides);
    return sides;
  }

  /// Routes a facet through a vertex next to it.
  [[nodiscard]] std::optional<Change> through_facet(Index v, Index f) const {
    const Triangle& t = state_.facets[f];
    const Nearness near = beside_any(before_[v], {at(t[0]), at(t[1]), at(t[2])});
    if (!std::isfinite(near.distance)) return std::nullopt;
    Change change{v, {f}, {}, {}, near.distance, near.bound()};
    add_fan(v, t, f, change);
    return change;
  }

  static void add_fan(Index v, const Triangle& t, Index from, Change& change) {
    for (std::size_t i = 0; i < 3; ++i) {
      Triangle part = t;
      part[i] = v;
      change.parts.push_back({part, from});
    }
  }

  /// Differences of nearby points are nearly exact, so the nearest corner comes first.
  [[nodiscard]] static Nearness beside_any(const Point& p, std::array<Point, 3> corners) {
    const auto nearest =
        std::min_element(corners.begin(), corners.end(),
                         [&](const Point& a, const Point& b) { return length(p - a) < length(p - b); });
    std::rotate(corners.begin(), nearest, corners.end());
    return beside_facet(p, corners[0], corners[1], corners[2]);
  }
  [[nodiscard]] static Nearness beside_any(const Point& p, const std::array<Point, 2>& ends) {
    const bool is_first = length(p - ends[0]) <= length(p - ends[1]);
    return beside_side(p, ends[is_first ? 0 : 1], ends[is_first ? 1 : 0]);
  }

  /// Routes a side through a vertex next to it, in all facets that have the side.
  [[nodiscard]] std::optional<Change> through_side(Index v, const Side& side,
                                                   std::span<const Index> near_facets) const {
    const Nearness near = beside_any(before_[v], std::array{at(side[0]), at(side[1])});
    if (!std::isfinite(near.distance)) return std::nullopt;
    Change change{v, {}, {}, side, near.distance, near.bound()};
    for (const Index f : near_facets) {
      if (!has(f, side[0]) || !has(f, side[1])) continue;
      change.facets.push_back(f);
      add_halves(v, side, state_.facets[f], f, change);
    }
    return change;
  }

  static void add_halves(Index v, const Side& side, const Triangle& t, Index from, Change& change) {
    for (const Index end : side) {
      Triangle part = t;
      std::replace(part.begin(), part.end(), end, v);
      change.parts.push_back({part, from});
    }
  }

  [[nodiscard]] bool has(Index f, Index v) const {
    const Triangle& t = state_.facets[f];
    return t[0] == v || t[1] == v || t[2] == v;
  }

  /// The vertex takes the place of the vertex that it was joined with in all facets, and one of these facets
  /// or sides is led through that other vertex: useful if the lost vertex stands out further. The other
  /// vertex is not needed if it is not one of the input.
  void through_star(Index v, std::span<const Index> near_facets, std::vector<Change>& changes) const {
    const Index w = standing_at(at(v), near_facets);
    if (w == no_index || std::any_of(state_.segments.begin(), state_.segments.end(),
                                     [&](const Segment& s) { return s[0] == w || s[1] == w; }))
      return;
    Change star{v, {}, {}, {}, length(before_[v] - at(w)), 0};
    star.bent = star.distance * (1 + 0x1p-48);
    const std::vector<Triangle> facets = take_star(w, near_facets, star);
    std::vector<Index> ends;
    for (const Triangle& t : facets)
      std::copy_if(t.begin(), t.end(), std::back_inserter(ends), [v](Index x) { return x != v; });
    sort_unique(ends);
    const auto place = [&](Index x) { return x == v ? before_[v] : at(x); };
    const auto add = [&](const Nearness& near, auto&& put) {
      if (!std::isfinite(near.distance)) return;
      Change change = star;
      change.distance += near.distance;
      change.bent += near.bound();
      for (std::size_t k = 0; k < facets.size(); ++k)
        if (!put(facets[k], star.facets[k], change)) change.parts.push_back({facets[k], star.facets[k]});
      changes.push_back(std::move(change));
    };
    if (w >= state_.input_vertices) add({0}, [](const Triangle&, Index, Change&) { return false; });
    for (const Triangle& t : facets)
      add(beside_any(at(w), {place(t[0]), place(t[1]), place(t[2])}),
          [&](const Triangle& u, Index from, Change& change) {
            if (u == t) add_fan(w, t, from, change);
            return u == t;
          });
    for (const Index x : ends)
      add(beside_any(at(w), std::array{before_[v], at(x)}),
          [&](const Triangle& u, Index from, Change& change) {
            const bool has_side = std::count(u.begin(), u.end(), x) != 0;
            if (has_side) add_halves(w, {v, x}, u, from, change);
            return has_side;
          });
  }

  /// Lists the facets at w in the change, and returns them with the vertex of the change instead of w.
  std::vector<Triangle> take_star(Index w, std::span<const Index> near_facets, Change& star) const {
    std::vector<Triangle> facets;
    for (const Index f : near_facets) {
      if (!has(f, w)) continue;
      star.facets.push_back(f);
      facets.push_back(state_.facets[f]);
      std::replace(facets.back().begin(), facets.back().end(), w, star.vertex);
    }
    return facets;
  }

  /// The corner of these facets at a place.
  [[nodiscard]] Index standing_at(const Point& place, std::span<const Index> facets) const {
    for (const Index f : facets)
      for (const Index v : state_.facets[f])
        if (at(v) == place) return v;
    return no_index;
  }

  // --- changes made

  static constexpr Index kNone = no_index;

  /// A surface with changes; for each facet and segment, the change that it comes from.
  struct Changed {
    State state;
    std::vector<double> bent;
    std::vector<Index> facet_change, segment_change;
  };

  [[nodiscard]] Changed changed(const std::vector<Change>& changes) const {
    Changed now;
    now.state.input_vertices = state_.input_vertices;
    now.state.vertices = state_.vertices;
    for (const Change& change : changes) now.state.vertices[change.vertex] = before_[change.vertex];
    add_facets(changes, now);
    add_segments(changes, now);
    return now;
  }

  void add_facets(const std::vector<Change>& changes, Changed& now) const {
    std::vector<Index> change_of(state_.facets.size(), kNone);
    for (Index c = 0; c < changes.size(); ++c)
      for (const Index f : changes[c].facets) change_of[f] = c;
    const auto add = [&](const Triangle& t, Index f, Index change, double bent) {
      now.state.facets.push_back(t);
      now.state.facet_parents.add(state_.facet_parents.of(f));
      now.state.known.push_back(change == kNone ? 1 : 0);
      now.bent.push_back(bent);
      now.facet_change.push_back(change);
    };
    for (Index f = 0; f < state_.facets.size(); ++f) {
      const Index c = change_of[f];
      if (c == kNone)
        add(state_.facets[f], f, kNone, bent_[f]);
      else
        for (const Change::Part& part : changes[c].parts)
          if (part.from == f) add(part.corners, f, c, bent_[f] + changes[c].bent);
    }
  }

  void add_segments(const std::vector<Change>& changes, Changed& now) const {
    std::map<Side, Index> at_side;
    for (Index c = 0; c < changes.size(); ++c)
      if (changes[c].side) at_side.emplace(*changes[c].side, c);
    for (Index s = 0; s < state_.segments.size(); ++s) {
      const auto [a, b] = state_.segments[s];
      const auto found = at_side.find(ascending(Side{a, b}));
      const Index c = found == at_side.end() ? kNone : found->second;
      const auto add = [&](const Segment& segment) {
        now.state.segments.push_back(segment);
        now.state.segment_parents.add(state_.segment_parents.of(s));
        now.segment_change.push_back(c);
      };
      if (c == kNone) {
        add({a, b});
      } else {
        add({a, changes[c].vertex});
        add({changes[c].vertex, b});
      }
    }
  }

  /// Leaves out changes that do not fit until the rest fits. Of two changes that do not fit together, the
  /// later one may be tried once more.
  void make(std::vector<Change> changes) {
    while (!changes.empty()) {
      Changed now = changed(changes);
      const auto [refused, postponed] = in_trouble(now);
      if (refused.empty() && postponed.empty()) {
        stand(changes, std::move(now));
        return;
      }
      for (const Index c : refused) lost_with(changes[c].vertex).tried.insert(key_of(changes[c]));
      std::vector<Change> kept;
      for (Index c = 0; c < changes.size(); ++c)
        if (refused.count(c) == 0 && (!refused.empty() || postponed.count(c) == 0))
          kept.push_back(std::move(changes[c]));
      changes = std::move(kept);
    }
  }

  Lost& lost_with(Index vertex) {
    return *std::lower_bound(lost_.begin(), lost_.end(), vertex,
                             [](const Lost& lost, Index v) { return lost.vertex < v; });
  }

  void stand(const std::vector<Change>& changes, Changed now) {
    for (const Change& change : changes)
      for (const Index v : lost_with(change.vertex).same) now.state.vertices[v] = before_[v];
    std::set<Index> done;
    for (const Change& change : changes) done.insert(change.vertex);
    std::erase_if(lost_, [&](const Lost& lost) { return done.count(lost.vertex) != 0; });
    for (const double bent : now.bent) most_ = std::max(most_, bent);
    state_ = std::move(now.state);
    bent_ = std::move(now.bent);
  }

  /// Changes that break the surface by themselves, and changes that do not fit together with an earlier one.
  [[nodiscard]] std::pair<std::set<Index>, std::set<Index>> in_trouble(const Changed& now) const {
    std::pair<std::set<Index>, std::set<Index>> found;
    const Complex complex = now.state.complex();
    const Elements elements = elements_of(complex, threads_);
    const auto change_of = [&](Index element) {
      const Element& e = elements.all[element];
      return e.corners == 3 ? now.facet_change[e.id] : e.corners == 2 ? now.segment_change[e.id] : kNone;
    };
    const VisitPair visit = [&](Index i, Index j, const Contacts&) {
      const Index a = change_of(i), b = change_of(j);
      if (a == kNone || b == kNone || a == b)
        found.first.insert(a == kNone ? b : a);
      else
        found.second.insert(std::max(a, b));
      return true;
    };
    for_each_offending_pair(complex, elements, visit, step_, {}, KnownElements(now.state, elements).known());
    for (const Flaw& flaw : elements.flaws)
      if (flaw.kind == DefectKind::degenerate_facet && now.facet_change[flaw.id] != kNone)
        found.first.insert(now.facet_change[flaw.id]);
    found.first.erase(kNone);
    return found;
  }

  State& state_;
  const std::span<const Point> before_;
  const Step& step_;
  const Threads& threads_;
  std::vector<Lost> lost_;    // by vertex
  std::vector<double> bent_;  // by facet
  double most_ = 0;
};

}  // namespace

double restore(State& state, std::span<const Point> before, const Step& step, const Threads& threads) {
  return Restoring(state, before, step, threads).run();
}

}  // namespace holdfast::repairing
