// The rule for sides is that of snap rounding (Hobby 1999): whatever passes through the cell of a vertex
// passes through the vertex. Here cells are balls, and the vertices stay.
#include "repair/bend.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "exact/predicates.h"
#include "numbers/sorted.h"
#include "repair/bent.h"
#include "repair/derived_facets.h"
#include "repair/near.h"
#include "surface/aabb_tree.h"
#include "surface/complex.h"

namespace holdfast::repairing {
namespace {

bool has_repeated_corners(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// The corners with vertex `old` replaced by `fresh`.
Triangle with(Index fresh, Index old, Triangle corners) {
  std::replace(corners.begin(), corners.end(), old, fresh);
  return corners;
}

/// Whether three points lie on a line.
bool are_aligned(const Point& p, const Point& q, const Point& r) {
  const exact::PointRef a{p.data()}, b{q.data()}, c{r.data()};
  return exact::orient2d(a, b, c, 0) == 0 && exact::orient2d(a, b, c, 1) == 0 &&
         exact::orient2d(a, b, c, 2) == 0;
}

bool holds(const Box& box, const Point& p) {
  for (std::size_t k = 0; k < 3; ++k)
    if (p[k] < box.low[k] || p[k] > box.high[k]) return false;
  return true;
}

// --- 1. What is near

bool is_near(const State& state, Index v, const Triangle& facet, double distance) {
  const auto at = [&](Index w) -> const Point& { return state.vertices[w]; };
  const auto& [a, b, c] = facet;
  if (v == a || v == b || v == c) return true;
  return beside_side(at(v), at(a), at(b)).distance <= distance ||
         beside_side(at(v), at(b), at(c)).distance <= distance ||
         beside_side(at(v), at(c), at(a)).distance <= distance ||
         beside_facet(at(v), at(a), at(b), at(c)).distance <= distance;
}

/// The vertices near each facet and then near each segment in trouble, including those that bending may bring
/// into reach.
std::vector<std::vector<Index>> list_near(const State& state, const Trouble& trouble,
                                          std::span<const Index> vertices, double gap, Work& work,
                                          const Step& step) {
  constexpr double kRoom = 4;       // gaps: bending may bring vertices nearer by some
  constexpr std::size_t kWork = 4;  // relative to finding a pair
  std::vector<Box> boxes;
  for (const Index v : vertices) boxes.push_back(box_round(state, std::array{v}, 0));
  const AabbTree tree(boxes);
  std::vector<std::vector<Index>> near(trouble.size());
  for (std::size_t k = 0; k < near.size() && !work.is_spent(); ++k) {
    if (k % 256 == 0) step(static_cast<double>(k) / static_cast<double>(near.size()));
    const bool is_facet = k < trouble.facets.size();
    const Box box =
        is_facet ? box_round(state, state.facets[trouble.facets[k]], kRoom * gap)
                 : box_round(state, state.segments[trouble.segments[k - trouble.facets.size()]], kRoom * gap);
    const auto visit_all = [&](auto&& is_near_it) {
      tree.for_each_item([&](const Box& other) { return !box.overlaps(other); },
                         [&](const AabbTree::Item& item) {
                           work.done += kWork;
                           if (is_near_it(vertices[item.id])) near[k].push_back(vertices[item.id]);
                         });
    };
    if (is_facet) {
      const Triangle& facet = state.facets[trouble.facets[k]];
      const auto at = [&](std::size_t i) -> const Point& { return state.vertices[facet[i]]; };
      const FarFromFacet is_far(at(0), at(1), at(2), kRoom * gap);
      visit_all([&](Index v) { return !is_far(state.vertices[v]) && is_near(state, v, facet, kRoom * gap); });
    } else {
      visit_all([](Index) { return true; });
    }
    std::sort(near[k].begin(), near[k].end());
  }
  return near;
}

/// Whether no side of a facet is within the gap of a vertex. `near` has the vertices near the facet.
bool is_idle(const State& state, const Triangle& t, std::span<const Index> near, double gap) {
  const auto is_corner = [&](Index v) { return v == t[0] || v == t[1] || v == t[2]; };
  if (!std::all_of(near.begin(), near.end(), is_corner)) return false;
  const auto is_flat = [&](std::size_t i) {
    const auto at = [&](std::size_t k) -> const Point& { return state.vertices[t[k % 3]]; };
    return beside_side(at(i), at(i + 1), at(i + 2)).distance <= gap;
  };
  return !is_flat(0) && !is_flat(1) && !is_flat(2);
}

/// Facets and segments with a side between two of the vertices. `near` is that of `list_near`.
void begin(const State& state, const Trouble& trouble, std::span<const Index> vertices,
           std::span<const std::vector<Index>> near, double gap, BentSurface& bent) {
  std::vector<std::uint8_t> is_vertex(state.vertices.size(), 0);
  for (const Index v : vertices) is_vertex[v] = 1;
  std::size_t next = 0;
  for (Index f = 0; f < state.facets.size(); ++f) {
    const Triangle& t = state.facets[f];
    const bool listed = next < trouble.facets.size() && trouble.facets[next] == f;
    std::vector<Index> lists;
    if (listed) lists.push_back(static_cast<Index>(next++));
    if (has_repeated_corners(t)) continue;
    if (is_vertex[t[0]] + is_vertex[t[1]] + is_vertex[t[2]] < 2) continue;
    const bool idle = !listed || is_idle(state, t, near[lists[0]], gap);
    bent.add(BentFacet{t, {f}, std::move(lists)}, idle);
  }
  next = 0;
  for (Index s = 0; s < state.segments.size(); ++s) {
    const bool listed = next < trouble.segments.size() && trouble.segments[next] == s;
    std::vector<Index> lists;
    if (listed) lists.push_back(static_cast<Index>(trouble.facets.size() + next++));
    const Segment& ends = state.segments[s];
    if (is_vertex[ends[0]] + is_vertex[ends[1]] == 2) bent.add(BentSegment{ends, s, lists}, !listed);
  }
}

// --- 2. and 3. Sides and facets

/// One side at a time is led through one vertex, in all facets that have the side: (a b x) becomes (a p x)
/// and (p b x), and vanishes if x is p. So the boundary of the facets stays the same, and closed surfaces
/// stay closed.
class Bending {
 public:
  /// `near` holds the vertices near each facet and segment, by the numbers in their `lists`.
  Bending(const State& state, std::vector<std::vector<Index>> near, BentSurface& surface, const Bend& how,
          Work& work)
      : state_(state),
        near_(std::move(near)),
        looked_at_(near_.size(), 0),
        surface_(surface),
        how_(how),
        gap_(how.gap),
        room_(how.room),
        work_(work) {}

  /// The longest sides come first: a facet thinner than the gap vanishes into its longest side. Ends early if
  /// this multiplies the facets: the state is a surface at every step.
  void run(const Step& step) {
    constexpr std::size_t kGrowth = 8, kRoom = 200;
    const std::size_t parts = surface_.facets().size() + surface_.segments().size();
    const std::size_t most_steps = 1000 + 60 * parts;
    const std::size_t most_facets =
        std::min(how_.most_facets, surface_.living() + kGrowth * near_.size() + kRoom);
    for (std::size_t steps = 0; steps < most_steps && surface_.living() <= most_facets; ++steps) {
      if (work_.is_spent()) return;
      if ((steps & 63) == 0) step(0.5);
      if (const std::optional<Side> side = surface_.next_side())
        bend_side(*side);
      else if (const std::optional<Index> facet = surface_.next_facet())
        bend_facet(*facet);
      else
        return;
    }
  }

 private:
  [[nodiscard]] const Point& at(Index v) const { return state_.vertices[v]; }

  void bend_side(const Side& side) {
    const BentSurface::AtSide* at_side = surface_.at(side);
    if (at_side == nullptr) return;
    const auto [through, nearest] = vertex_beside(side, *at_side);
    if (through == no_index || comes_back(side, *at_side, through)) return;
    const BentSurface::AtSide here = surface_.forget(side);
    work_.done += here.facets.size() + here.segments.size();
    for (const Index f : here.facets) {
      if (!surface_.facet(f).lives) continue;
      const BentFacet part = surface_.take(f, nearest.bound());
      if (std::count(part.corners.begin(), part.corners.end(), through) != 0) continue;
      for (const Index end : side) {
        BentFacet half = part;
        half.corners = with(through, end, part.corners);
        surface_.add(std::move(half));
      }
    }
    for (const Index s : here.segments) {
      if (!surface_.segment(s).lives) continue;
      BentSegment part = surface_.take_segment(s, distance_from_origin(surface_.segment(s), through));
      const Segment ends = part.ends;
      part.ends = {ends[0], through};
      surface_.add(part);
      part.ends = {through, ends[1]};
      surface_.add(part);
    }
  }

  /// Whether a facet or a segment that was removed before would come back. Two vertices near a side may each
  /// pass the side that ends in the other; without this test, the two ways to divide the space between them
  /// would alternate for ever.
  [[nodiscard]] bool comes_back(const Side& side, const BentSurface::AtSide& here, Index through) const {
    const auto of_facet = [&](Index f) {
      const Triangle& corners = surface_.facet(f).corners;
      if (!surface_.facet(f).lives || std::count(corners.begin(), corners.end(), through) != 0) return false;
      return std::any_of(side.begin(), side.end(),
                         [&](Index end) { return surface_.had(with(through, end, corners)); });
    };
    const auto of_segment = [&](Index s) {
      return surface_.segment(s).lives && std::any_of(side.begin(), side.end(), [&](Index end) {
               return surface_.had({through, end}, surface_.segment(s).origin);
             });
    };
    return std::any_of(here.facets.begin(), here.facets.end(), of_facet) ||
           std::any_of(here.segments.begin(), here.segments.end(), of_segment);
  }

  /// The nearest of the vertices that a side passes and may be led through.
  [[nodiscard]] std::pair<Index, Nearness> vertex_beside(const Side& side, const BentSurface::AtSide& here) {
    Index best = no_index;
    Nearness nearest;
    bool bends = how_.touching == Touching::bends;
    const Box box = box_round(state_, side, gap_);
    ++looked_;
    const auto look = [&](const std::vector<Index>& lists) {
      for (const Index list : lists) {
        if (std::exchange(looked_at_[list], looked_) == looked_) continue;
        work_.done += near_[list].size();
        for (const Index v : near_[list]) {
          if (v == side[0] || v == side[1] || v == best || !holds(box, at(v))) continue;
          const Nearness near = beside_side(at(v), at(side[0]), at(side[1]));
          if (!(near.distance <= gap_)) continue;
          bends = bends || !touches(side, v);
          if (!(near.distance < nearest.distance) || !has_room(here, v, near.bound())) continue;
          nearest = near;
          best = v;
        }
      }
    };
    for (const Index f : here.facets)
      if (surface_.facet(f).lives) look(surface_.facet(f).lists);
    for (const Index s : here.segments)
      if (surface_.segment(s).lives) look(surface_.segment(s).lists);
    return {bends ? best : no_index, nearest};
  }

  /// Whether the facets and segments of a side may be bent to a vertex, which bends the facets by so much
  /// more.
  [[nodiscard]] bool has_room(const BentSurface::AtSide& here, Index v, double more) const {
    const auto facet_fits = [&](const BentFacet& part) { return !part.lives || part.bent + more <= room_; };
    const auto segment_fits = [&](const BentSegment& part) {
      return !part.lives || distance_from_origin(part, v) <= room_;
    };
    return std::all_of(here.facets.begin(), here.facets.end(),
                       [&](Index f) { return facet_fits(surface_.facet(f)); }) &&
           std::all_of(here.segments.begin(), here.segments.end(),
                       [&](Index s) { return segment_fits(surface_.segment(s)); });
  }

  // All points within a distance of a segment are a convex set. So parts between vertices in it stay in it,
  // however many they are: the distances of a segment need not be added up, as those of a facet are.
  [[nodiscard]] double distance_from_origin(const BentSegment& part, Index v) const {
    const auto [a, b] = state_.segments[part.origin];
    return distance_above(at(v), at(a), at(b));
  }

  void bend_facet(Index f) {
    if (!surface_.facet(f).lives) return;
    const auto [through, nearness] = vertex_beside(f);
    if (through == no_index) return;
    const BentFacet facet = surface_.take(f, nearness.bound());
    for (std::size_t i = 0; i < 3; ++i) {
      BentFacet part = facet;
      part.corners[i] = through;
      surface_.add(std::move(part));
    }
  }

  /// The first of the vertices that a facet passes and may be led through.
  [[nodiscard]] std::pair<Index, Nearness> vertex_beside(Index f) {
    const auto [a, b, c] = surface_.facet(f).corners;
    Index first = no_index;
    Nearness nearness;
    for (const Index list : surface_.facet(f).lists) {
      work_.done += near_[list].size();
      for (const Index v : near_[list]) {
        if (v == a || v == b || v == c) continue;
        const Nearness near = beside_facet(at(v), at(a), at(b), at(c));
        // All points of a sliver are near its sides, and these are led through nearby vertices.
        if (!(near.distance <= gap_) || near.tilt > gap_) continue;
        if (!(surface_.facet(f).bent + near.bound() <= room_)) continue;
        if (first == no_index) {
          first = v;
          nearness = near;
        }
        if (how_.touching == Touching::bends || !touches({a, b, c}, v)) return {first, nearness};
      }
    }
    return {no_index, nearness};
  }

  // Exact: see Touching.
  [[nodiscard]] bool touches(const Side& side, Index v) const {
    return are_aligned(at(side[0]), at(side[1]), at(v));
  }
  [[nodiscard]] bool touches(const Triangle& facet, Index v) const {
    return exact::orient3d(at(facet[0]).data(), at(facet[1]).data(), at(facet[2]).data(), at(v).data()) == 0;
  }

  const State& state_;
  const std::vector<std::vector<Index>> near_;
  std::vector<std::size_t> looked_at_;  // by list: the last side for which it was searched
  std::size_t looked_ = 0;              // sides
  BentSurface& surface_;
  const Bend how_;
  const double gap_, room_;
  Work& work_;
};

// --- the result

void deliver_facets(const BentSurface& bent, State& state) {
  std::vector<std::array<Index, 2>> parts;  // {first origin, in the bent surface}
  std::vector<std::uint8_t> is_bent(state.facets.size(), 0);
  for (Index k = 0; k < bent.facets().size(); ++k) {
    for (const Index origin : bent.facet(k).origins) is_bent[origin] = 1;
    if (bent.facet(k).lives) parts.push_back({bent.facet(k).origins[0], k});
  }
  std::sort(parts.begin(), parts.end());
  auto part = parts.begin();
  DerivedFacets facets(state);
  std::vector<std::uint8_t> known;
  std::vector<Index> sheet;
  const auto take = [&](const Triangle& t, std::span<const Index> origins) {
    const Index f = origins[0];
    facets.add(t, origins);
    const bool same = origins.size() == 1 && t == state.facets[f];
    if (!state.known.empty()) known.push_back(same ? state.known[f] : 0);
    if (!state.sheet.empty()) sheet.push_back(same ? state.sheet[f] : no_index);
  };
  for (Index f = 0; f < state.facets.size(); ++f) {
    if (has_repeated_corners(state.facets[f])) continue;
    if (is_bent[f] == 0) {
      take(state.facets[f], std::array{f});
      continue;
    }
    for (; part != parts.end() && (*part)[0] == f; ++part)
      take(bent.facet((*part)[1]).corners, bent.facet((*part)[1]).origins);
  }
  std::move(facets).move_to(state);
  state.known = std::move(known);
  state.sheet = std::move(sheet);
}

void deliver_segments(const BentSurface& bent, State& state) {
  if (state.segments.empty()) return;
  std::map<Index, std::vector<Segment>> parts;
  std::set<Index> is_bent;
  for (const BentSegment& segment : bent.segments()) {
    is_bent.insert(segment.origin);
    if (segment.lives) parts[segment.origin].push_back(segment.ends);
  }
  std::vector<Segment> segments;
  Parents parents;
  for (Index s = 0; s < state.segments.size(); ++s) {
    if (is_bent.count(s) == 0) parts[s] = {state.segments[s]};
    for (const Segment& part : parts[s]) {
      if (part[0] == part[1]) continue;
      segments.push_back(part);
      parents.add(state.segment_parents.of(s));
    }
  }
  state.segments = std::move(segments);
  state.segment_parents = std::move(parents);
}

}  // namespace

double bend(State& state, const Trouble& trouble, std::span<const Index> vertices, const Bend& how,
            Work& work, const Step& step) {
  BentSurface bent(state.vertices);
  std::vector<std::vector<Index>> near = list_near(state, trouble, vertices, how.gap, work, step);
  begin(state, trouble, vertices, near, how.gap, bent);
  Bending(state, std::move(near), bent, how, work).run(step);
  deliver_facets(bent, state);
  deliver_segments(bent, state);
  return bent.most();
}

}  // namespace holdfast::repairing
