// What lies within a distance of each other is joined, by bending facets rather than by moving vertices.
//
// The rule for sides is that of snap rounding (Hobby 1999): whatever passes through the cell of a vertex
// passes through the vertex. Here cells are balls, and the vertices stay. Distances are computed in floating
// point: they choose what is joined, never whether the result is valid.
#include "repair/settle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "numbers/sorted.h"
#include "surface/aabb_tree.h"
#include "surface/complex.h"

namespace holdfast::repairing {
namespace {

using Vector = std::array<double, 3>;
using Side = std::array<Index, 2>;

Vector minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& u, const Vector& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }
Vector cross(const Vector& u, const Vector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
double length(const Vector& u) {
  const double most = std::max({std::fabs(u[0]), std::fabs(u[1]), std::fabs(u[2])});
  if (!(most > 0) || !std::isfinite(most)) return most;
  const Vector v{u[0] / most, u[1] / most, u[2] / most};
  return most * std::sqrt(dot(v, v));
}

/// Where a vertex stands beside a side or facet.
struct Nearness {
  double distance = std::numeric_limits<double>::infinity();  ///< as computed
  double size = 0;      ///< of the numbers that it was computed from, for a bound on its error
  double t = 0, s = 0;  ///< along the side; or the weights of the second and third corner
};

/// Beside the inside of the side ab.
Nearness beside_side(const Point& p, const Point& a, const Point& b) {
  const Vector d = minus(b, a), w = minus(p, a);
  const double long_d = length(d);
  Nearness near;
  near.size = std::max(long_d, length(w));
  if (!(long_d > 0)) return near;
  const Vector e{d[0] / long_d, d[1] / long_d, d[2] / long_d};
  const double t = dot(w, e);
  if (!(t > 0) || !(t < long_d)) return near;
  near.t = t;
  near.distance = length(cross(e, w));
  return near;
}

/// Beside the inside of the facet abc.
Nearness beside_facet(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Vector u = minus(b, a), v = minus(c, a), w = minus(p, a);
  Nearness near;
  near.size = std::max({length(u), length(v), length(w)});
  if (!(near.size > 0)) return near;
  const auto scaled = [&](const Vector& x) {
    return Vector{x[0] / near.size, x[1] / near.size, x[2] / near.size};
  };
  const Vector us = scaled(u), vs = scaled(v), ws = scaled(w), n = cross(us, vs);
  const double nn = dot(n, n);
  if (!(nn > 0x1p-1000)) return near;
  const double t = dot(cross(ws, vs), n) / nn, s = dot(cross(us, ws), n) / nn;
  if (!(t > 0) || !(s > 0) || !(t + s < 1)) return near;
  near.t = t;
  near.s = s;
  near.distance = std::fabs(dot(ws, n)) / std::sqrt(nn) * near.size;
  return near;
}

/// The middle between two segments where they are nearest to each other, if that is inside both.
struct Passing {
  double distance = std::numeric_limits<double>::infinity();
  Point middle{};
};

Passing pass(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Vector u = minus(b, a), v = minus(d, c), w = minus(c, a);
  const double long_u = length(u), long_v = length(v);
  Passing passing;
  if (!(long_u > 0) || !(long_v > 0)) return passing;
  const auto over = [](const Vector& x, double by) { return Vector{x[0] / by, x[1] / by, x[2] / by}; };
  const Vector e = over(u, long_u), f = over(v, long_v), n = cross(e, f);
  const double nn = dot(n, n);
  constexpr double kParallel = 0x1p-70;  // square of an angle
  if (!(nn > kParallel)) return passing;
  const double t = dot(cross(w, f), n) / nn, s = dot(cross(w, e), n) / nn;
  if (!(t > 0) || !(t < long_u) || !(s > 0) || !(s < long_v)) return passing;
  Point p{}, q{};
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = a[k] + t * e[k];
    q[k] = c[k] + s * f[k];
    passing.middle[k] = p[k] / 2 + q[k] / 2;
  }
  passing.distance = length(minus(p, q));
  return passing;
}

double bound(const Nearness& near) { return near.distance + near.size * 0x1p-49; }

class Settling {
 public:
  Settling(State& state, const Trouble& trouble, const Settle& how, const Step& step)
      : state_(state), trouble_(trouble), how_(how), gap_(how.gap), step_(step) {}

  double run() {
    list_vertices();
    const double merged = merge_vertices();
    if (how_.passings) add_passings();
    if (how_.most > 0) room_ = how_.most - merged;
    list_near();
    list_local();
    bend();
    deliver();
    drop_unused(state_);
    return merged + most_;
  }

 private:
  [[nodiscard]] const Point& at(Index v) const { return state_.vertices[v]; }

  /// Those of what is in trouble, and all others near it.
  void list_vertices() {
    std::vector<std::uint8_t> used(state_.vertices.size(), 0);
    std::vector<Box> boxes;
    for (const Index f : trouble_.facets) boxes.push_back(box_of(state_.facets[f], gap_));
    for (const Index s : trouble_.segments) boxes.push_back(box_of(state_.segments[s], gap_));
    const AabbTree tree(boxes);
    const auto use = [&](const auto& entities) {
      for (const auto& corners : entities)
        for (const Index v : corners) {
          if (std::exchange(used[v], std::uint8_t{1}) != 0 || !is_finite(v)) continue;
          if (tree.overlaps_any(box_of(std::array{v}, 0))) vertices_.push_back(v);
        }
    };
    use(state_.facets);
    use(state_.segments);
    std::sort(vertices_.begin(), vertices_.end());
  }

  [[nodiscard]] bool is_finite(Index v) const {
    return std::isfinite(at(v)[0]) && std::isfinite(at(v)[1]) && std::isfinite(at(v)[2]);
  }

  [[nodiscard]] Box box_of(std::span<const Index> corners, double margin) const {
    Box box{at(corners[0]), at(corners[0])};
    for (const Index v : corners) box.extend({at(v), at(v)});
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] -= margin;
      box.high[k] += margin;
    }
    return box;
  }

  // --- 1. Vertices ------------------------------------------------------------------------------------

  double merge_vertices() {
    std::vector<Box> boxes;
    for (const Index v : vertices_) boxes.push_back(box_of(std::array{v}, gap_ / 2));
    std::vector<std::tuple<Index, Index, double>> pairs;
    AabbTree(boxes).for_each_overlap(
        [&](Index i, Index j) {
          const auto [v, w] = std::minmax(vertices_[i], vertices_[j]);
          const double distance = length(minus(at(v), at(w)));
          const bool may_move = w >= state_.input_vertices || how_.moves_input;
          if (may_move && distance <= gap_) pairs.emplace_back(v, w, distance);
          return true;
        },
        [](Index, Index) { return false; }, step_);
    std::sort(pairs.begin(), pairs.end());
    std::map<Index, Index> into;
    double most = 0;
    for (const auto& [v, w, distance] : pairs) {
      if (into.count(v) != 0 || into.count(w) != 0) continue;
      into[w] = v;
      most = std::max(most, distance * (1 + 0x1p-48));
    }
    if (into.empty()) return 0;
    // A vertex of the input keeps its slot, which takes the place of what it became.
    for (const auto& [w, v] : into)
      if (w < state_.input_vertices) state_.vertices[w] = at(v);
    const auto rename = [&](auto& entities, std::vector<std::uint8_t>* known) {
      for (std::size_t i = 0; i < entities.size(); ++i)
        for (Index& v : entities[i])
          if (const auto found = into.find(v); found != into.end()) {
            v = found->second;
            if (known != nullptr && !known->empty()) (*known)[i] = 0;
          }
    };
    rename(state_.facets, &state_.known);
    rename(state_.segments, nullptr);
    std::erase_if(vertices_, [&](Index v) { return into.count(v) != 0; });
    return most;
  }

  // --- Sides that pass each other ---------------------------------------------------------------------

  /// New vertices where two sides pass each other at most the gap away, unless a vertex is there.
  void add_passings() {
    std::vector<Side> sides;
    for (const Index f : trouble_.facets) {
      const Triangle& t = state_.facets[f];
      for (std::size_t i = 0; i < 3; ++i)
        if (t[i] != t[(i + 1) % 3]) sides.push_back(ascending(Side{t[i], t[(i + 1) % 3]}));
    }
    for (const Index s : trouble_.segments)
      if (state_.segments[s][0] != state_.segments[s][1])
        sides.push_back(ascending(Side(state_.segments[s])));
    sort_unique(sides);
    std::vector<Box> boxes;
    for (const Side& side : sides) boxes.push_back(box_of(side, gap_));
    std::vector<std::pair<double, Point>> found;
    AabbTree(boxes).for_each_overlap(
        [&](Index i, Index j) {
          const auto [a, b] = sides[i];
          const auto [c, d] = sides[j];
          if (a == c || a == d || b == c || b == d) return true;
          const Passing passing = pass(at(a), at(b), at(c), at(d));
          if (passing.distance <= gap_) found.emplace_back(passing.distance, passing.middle);
          return true;
        },
        [](Index, Index) { return false; }, step_);
    std::sort(found.begin(), found.end());
    Cells cells(gap_);
    for (const Index v : vertices_) cells.add(at(v));
    for (const auto& [distance, middle] : found) {
      if (cells.has_near(middle)) continue;
      cells.add(middle);
      vertices_.push_back(static_cast<Index>(state_.vertices.size()));
      state_.vertices.push_back(middle);
    }
  }

  /// Points by cells of a grid as wide as the gap.
  class Cells {
   public:
    explicit Cells(double gap) : gap_(gap) {}
    void add(const Point& p) { points_[cell(p, {0, 0, 0})].push_back(p); }
    [[nodiscard]] bool has_near(const Point& p) const {
      for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
          for (int z = -1; z <= 1; ++z) {
            const auto found = points_.find(cell(p, {x, y, z}));
            if (found == points_.end()) continue;
            for (const Point& q : found->second)
              if (length(minus(p, q)) <= gap_) return true;
          }
      return false;
    }

   private:
    [[nodiscard]] std::array<double, 3> cell(const Point& p, std::array<int, 3> by) const {
      std::array<double, 3> c{};
      for (std::size_t k = 0; k < 3; ++k) c[k] = std::floor(p[k] / gap_) + by[k];
      return c;
    }
    double gap_;
    std::map<std::array<double, 3>, std::vector<Point>> points_;
  };

  // --- What is near -----------------------------------------------------------------------------------

  /// For each facet and segment in trouble the vertices near it, with room for bending.
  void list_near() {
    constexpr double kRoom = 4;
    std::vector<Box> boxes;
    for (const Index v : vertices_) boxes.push_back(box_of(std::array{v}, 0));
    for (const Index f : trouble_.facets) boxes.push_back(box_of(state_.facets[f], kRoom * gap_));
    for (const Index s : trouble_.segments) boxes.push_back(box_of(state_.segments[s], kRoom * gap_));
    near_.resize(boxes.size() - vertices_.size());
    const auto first = static_cast<Index>(vertices_.size());
    AabbTree(boxes).for_each_overlap(
        [&](Index i, Index j) {
          if (i > j) std::swap(i, j);
          if (i >= first || j < first) return true;
          if (is_near(vertices_[i], j - first, kRoom * gap_)) near_[j - first].push_back(vertices_[i]);
          return true;
        },
        [](Index, Index) { return false; }, step_);
    for (std::vector<Index>& list : near_) std::sort(list.begin(), list.end());
  }

  [[nodiscard]] bool is_near(Index v, std::size_t element, double distance) const {
    if (element >= trouble_.facets.size()) return true;
    const auto& [a, b, c] = state_.facets[trouble_.facets[element]];
    if (v == a || v == b || v == c) return true;
    return beside_side(at(v), at(a), at(b)).distance <= distance ||
           beside_side(at(v), at(b), at(c)).distance <= distance ||
           beside_side(at(v), at(c), at(a)).distance <= distance ||
           beside_facet(at(v), at(a), at(b), at(c)).distance <= distance;
  }

  // --- 2. and 3. Sides and facets ---------------------------------------------------------------------
  //
  // One side at a time is led through one vertex, in all that have it: (a b x) becomes (a p x) and (p b x),
  // and vanishes where x is p. So the boundary of the facets stays what it was, and what was closed is.

  // Facets that come to have the same corners are one from then on, with all that these came from.

  struct LocalFacet {
    Triangle corners;
    std::vector<Index> origins;  // in the state, ascending
    std::vector<Index> lists;    // in near_
    double bent = 0;             // by how much its points were moved so far
    bool lives = true;
  };
  struct LocalSegment {
    Segment ends;
    Index origin;
    std::vector<Index> lists;
    bool lives = true;
  };

  /// Facets and segments with a side between two of the vertices.
  void list_local() {
    std::vector<std::uint8_t> is_vertex(state_.vertices.size(), 0);
    for (const Index v : vertices_) is_vertex[v] = 1;
    std::size_t next = 0;
    for (Index f = 0; f < state_.facets.size(); ++f) {
      const Triangle& t = state_.facets[f];
      const bool listed = next < trouble_.facets.size() && trouble_.facets[next] == f;
      std::vector<Index> lists;
      if (listed) lists.push_back(static_cast<Index>(next++));
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
        gone_.insert(f);
        continue;
      }
      if (is_vertex[t[0]] + is_vertex[t[1]] + is_vertex[t[2]] >= 2) add(LocalFacet{t, {f}, lists});
    }
    next = 0;
    for (Index s = 0; s < state_.segments.size(); ++s) {
      const bool listed = next < trouble_.segments.size() && trouble_.segments[next] == s;
      std::vector<Index> lists;
      if (listed) lists.push_back(static_cast<Index>(trouble_.facets.size() + next++));
      const Segment& ends = state_.segments[s];
      if (is_vertex[ends[0]] + is_vertex[ends[1]] == 2) add(LocalSegment{ends, s, lists});
    }
  }

  void add(LocalFacet facet) {
    most_ = std::max(most_, facet.bent);
    const auto fresh = static_cast<Index>(facets_.size());
    const auto [found, is_new] = facet_with_.try_emplace(ascending(facet.corners), fresh);
    if (!is_new && facets_[found->second].lives) {
      LocalFacet& other = facets_[found->second];
      join(other.origins, facet.origins);
      join(other.lists, facet.lists);
      other.bent = std::max(other.bent, facet.bent);
      return;
    }
    found->second = fresh;
    for (std::size_t i = 0; i < 3; ++i)
      note(ascending(Side{facet.corners[i], facet.corners[(i + 1) % 3]})).facets.push_back(fresh);
    if (!facet.lists.empty()) whole_.push_back(fresh);
    facets_.push_back(std::move(facet));
  }
  static void join(std::vector<Index>& list, const std::vector<Index>& other) {
    list.insert(list.end(), other.begin(), other.end());
    sort_unique(list);
  }
  void add(const LocalSegment& segment) {
    const auto index = static_cast<Index>(segments_.size());
    segments_.push_back(segment);
    note(ascending(Side(segment.ends))).segments.push_back(index);
  }

  struct AtSide {
    std::vector<Index> facets, segments;
  };
  AtSide& note(const Side& side) {
    const auto [found, is_new] = at_side_.try_emplace(side);
    if (is_new) sides_.emplace(length(minus(at(side[0]), at(side[1]))), side);
    return found->second;
  }

  /// The longest sides first: a facet that is thinner than the gap vanishes into its longest side.
  void bend() {
    const std::size_t most_steps = 10000 + 60 * facets_.size();
    for (std::size_t steps = 0; steps < most_steps; ++steps) {
      if ((steps & 63) == 0) step_(0.5);
      if (!sides_.empty()) {
        const auto last = std::prev(sides_.end());
        const Side side = last->second;
        sides_.erase(last);
        bend_side(side);
      } else if (!whole_.empty()) {
        const Index f = whole_.back();
        whole_.pop_back();
        bend_facet(f);
      } else {
        return;
      }
    }
  }

  void bend_side(const Side& side) {
    const auto at_here = at_side_.find(side);
    if (at_here == at_side_.end()) return;
    const AtSide here = at_here->second;
    Index best = no_index;
    Nearness nearest;
    const auto look = [&](const std::vector<Index>& lists) {
      for (const Index list : lists)
        for (const Index v : near_[list]) {
          if (v == side[0] || v == side[1] || v == best) continue;
          const Nearness near = beside_side(at(v), at(side[0]), at(side[1]));
          if (!(near.distance <= gap_) || !(near.distance < nearest.distance)) continue;
          if (!has_room(here, bound(near))) continue;
          nearest = near;
          best = v;
        }
    };
    for (const Index f : here.facets)
      if (facets_[f].lives) look(facets_[f].lists);
    for (const Index s : here.segments)
      if (segments_[s].lives) look(segments_[s].lists);
    if (best == no_index) return;
    at_side_.erase(side);
    for (const Index f : here.facets) {
      if (!facets_[f].lives) continue;
      facets_[f].lives = false;
      LocalFacet part = facets_[f];
      part.lives = true;
      part.bent += bound(nearest);
      most_ = std::max(most_, part.bent);
      if (std::count(part.corners.begin(), part.corners.end(), best) != 0) continue;
      for (const Index end : side) {
        LocalFacet half = part;
        std::replace(half.corners.begin(), half.corners.end(), end, best);
        add(std::move(half));
      }
    }
    for (const Index s : here.segments) {
      if (!segments_[s].lives) continue;
      segments_[s].lives = false;
      const LocalSegment whole = segments_[s];
      add(LocalSegment{{whole.ends[0], best}, whole.origin, whole.lists});
      add(LocalSegment{{best, whole.ends[1]}, whole.origin, whole.lists});
    }
  }

  [[nodiscard]] bool has_room(const AtSide& here, double more) const {
    return std::all_of(here.facets.begin(), here.facets.end(),
                       [&](Index f) { return !facets_[f].lives || facets_[f].bent + more <= room_; });
  }

  void bend_facet(Index f) {
    if (!facets_[f].lives) return;
    const LocalFacet facet = facets_[f];
    const auto& [a, b, c] = facet.corners;
    for (const Index list : facet.lists)
      for (const Index v : near_[list]) {
        if (v == a || v == b || v == c) continue;
        const Nearness near = beside_facet(at(v), at(a), at(b), at(c));
        if (!(near.distance <= gap_) || !(facet.bent + bound(near) <= room_)) continue;
        facets_[f].lives = false;
        for (std::size_t i = 0; i < 3; ++i) {
          LocalFacet part = facet;
          part.corners[i] = v;
          part.bent += bound(near);
          add(std::move(part));
        }
        return;
      }
  }

  void deliver() {
    std::map<Index, std::vector<Index>> parts;  // by first origin, in facets_
    std::set<Index> local;
    for (Index k = 0; k < facets_.size(); ++k) {
      local.insert(facets_[k].origins.begin(), facets_[k].origins.end());
      if (facets_[k].lives) parts[facets_[k].origins[0]].push_back(k);
    }
    std::vector<Triangle> facets;
    Parents parents;
    std::vector<std::uint8_t> known;
    std::vector<Index> list;
    const auto take = [&](const Triangle& t, std::span<const Index> origins) {
      const Index f = origins[0];
      facets.push_back(t);
      list.clear();
      for (const Index origin : origins) {
        const auto of = state_.facet_parents.of(origin);
        list.insert(list.end(), of.begin(), of.end());
      }
      sort_unique(list);
      parents.add(list);
      const bool same = origins.size() == 1 && t == state_.facets[f];
      if (!state_.known.empty()) known.push_back(same ? state_.known[f] : 0);
    };
    for (Index f = 0; f < state_.facets.size(); ++f) {
      if (gone_.count(f) != 0) continue;
      if (local.count(f) == 0) {
        take(state_.facets[f], std::array{f});
        continue;
      }
      if (const auto own = parts.find(f); own != parts.end())
        for (const Index k : own->second) take(facets_[k].corners, facets_[k].origins);
    }
    state_.facets = std::move(facets);
    state_.facet_parents = std::move(parents);
    state_.known = std::move(known);
    deliver_segments();
  }

  void deliver_segments() {
    if (state_.segments.empty()) return;
    std::map<Index, std::vector<Segment>> parts;
    std::set<Index> local;
    for (const LocalSegment& segment : segments_) {
      local.insert(segment.origin);
      if (segment.lives) parts[segment.origin].push_back(segment.ends);
    }
    std::vector<Segment> segments;
    Parents parents;
    for (Index s = 0; s < state_.segments.size(); ++s) {
      if (local.count(s) == 0) parts[s] = {state_.segments[s]};
      for (const Segment& part : parts[s]) {
        segments.push_back(part);
        parents.add(state_.segment_parents.of(s));
      }
    }
    state_.segments = std::move(segments);
    state_.segment_parents = std::move(parents);
  }

  State& state_;
  const Trouble& trouble_;
  const Settle& how_;
  const double gap_;
  double room_ = std::numeric_limits<double>::infinity();  // for bending
  const Step& step_;
  std::vector<Index> vertices_;
  std::vector<std::vector<Index>> near_;  // vertices, by facets and then segments in trouble
  std::vector<LocalFacet> facets_;
  std::vector<LocalSegment> segments_;
  std::map<Triangle, Index> facet_with_;  // by its corners, ascending: the last of them
  std::map<Side, AtSide> at_side_;
  std::set<std::pair<double, Side>> sides_;  // to look at
  std::vector<Index> whole_;                 // facets to look at
  std::set<Index> gone_;                     // facets of the state that have no corners of their own any more
  double most_ = 0;
};

}  // namespace

Trouble trouble_of(const State& state, const Step& step, const Threads& threads) {
  const Complex complex = state.complex();
  const Elements elements = elements_of(complex, threads);
  Trouble trouble;
  const VisitPair visit = [&](Index i, Index j, const Contacts&) {
    for (const Index k : {i, j}) {
      const Element& element = elements.all[k];
      if (element.corners == 3) trouble.facets.push_back(element.id);
      if (element.corners == 2) trouble.segments.push_back(element.id);
    }
    return true;
  };
  for_each_offending_pair(complex, elements, visit, step, {}, known_elements(state, elements));
  for (const Flaw& flaw : elements.flaws)
    if (flaw.kind == DefectKind::degenerate_facet) trouble.facets.push_back(flaw.id);
  sort_unique(trouble.facets);
  sort_unique(trouble.segments);
  return trouble;
}

double settle(State& state, const Trouble& trouble, const Settle& how, const Step& step) {
  return Settling(state, trouble, how, step).run();
}

}  // namespace holdfast::repairing
