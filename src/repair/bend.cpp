// The rule for sides is that of snap rounding (Hobby 1999): whatever passes through the cell of a vertex
// passes through the vertex. Here cells are balls, and the vertices stay.
#include "repair/bend.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "numbers/sorted.h"
#include "repair/near.h"
#include "surface/aabb_tree.h"
#include "surface/complex.h"

namespace holdfast::repairing {
namespace {

using Side = std::array<Index, 2>;

class Bending {
 public:
  Bending(State& state, const Trouble& trouble, std::span<const Index> vertices, double gap, double room,
          const Step& step)
      : state_(state), trouble_(trouble), vertices_(vertices), gap_(gap), room_(room), step_(step) {}

  double run() {
    list_near();
    list_local();
    bend();
    deliver();
    return most_;
  }

 private:
  [[nodiscard]] const Point& at(Index v) const { return state_.vertices[v]; }

  // --- What is near -----------------------------------------------------------------------------------

  /// For each facet and segment in trouble the vertices near it, with room for bending.
  void list_near() {
    constexpr double kRoom = 4;
    std::vector<Box> boxes;
    for (const Index v : vertices_) boxes.push_back(box_round(state_, std::array{v}, 0));
    for (const Index f : trouble_.facets) boxes.push_back(box_round(state_, state_.facets[f], kRoom * gap_));
    for (const Index s : trouble_.segments)
      boxes.push_back(box_round(state_, state_.segments[s], kRoom * gap_));
    near_.resize(boxes.size() - vertices_.size());
    looked_at_.resize(near_.size(), 0);
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
    double bent = 0;
    bool lives = true;
  };

  static bool has_repeated_corners(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

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
      if (has_repeated_corners(t)) continue;
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
    ++living_;
  }
  void end(Index f) {
    facets_[f].lives = false;
    --living_;
  }
  static void join(std::vector<Index>& list, const std::vector<Index>& other) {
    list.insert(list.end(), other.begin(), other.end());
    sort_unique(list);
  }
  /// What a segment is led along twice it has once.
  void add(const LocalSegment& segment) {
    most_ = std::max(most_, segment.bent);
    const auto index = static_cast<Index>(segments_.size());
    const Side ends = ascending(Side(segment.ends));
    const auto [found, is_new] = segment_with_.try_emplace({ends, segment.origin}, index);
    if (!is_new && segments_[found->second].lives) {
      LocalSegment& other = segments_[found->second];
      other.bent = std::max(other.bent, segment.bent);
      return;
    }
    found->second = index;
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

  /// The longest sides first: a facet that is thinner than the gap vanishes into its longest side. Ends early
  /// where far more facets come of it than there were: what is left then is a surface, too.
  void bend() {
    constexpr std::size_t kGrowth = 8, kRoom = 200;
    const std::size_t most_steps = 1000 + 60 * facets_.size();
    const std::size_t most_facets = living_ + kGrowth * near_.size() + kRoom;
    for (std::size_t steps = 0; steps < most_steps && living_ <= most_facets; ++steps) {
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
    const Box box = box_round(state_, side, gap_);
    ++looked_;
    const auto look = [&](const std::vector<Index>& lists) {
      for (const Index list : lists) {
        if (std::exchange(looked_at_[list], looked_) == looked_) continue;
        for (const Index v : near_[list]) {
          if (v == side[0] || v == side[1] || v == best || !holds(box, at(v))) continue;
          const Nearness near = beside_side(at(v), at(side[0]), at(side[1]));
          if (!(near.distance <= gap_) || !(near.distance < nearest.distance)) continue;
          if (!has_room(here, near.bound())) continue;
          nearest = near;
          best = v;
        }
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
      end(f);
      LocalFacet part = facets_[f];
      part.lives = true;
      part.bent += nearest.bound();
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
      LocalSegment part = segments_[s];
      part.lives = true;
      part.bent += nearest.bound();
      const Segment ends = part.ends;
      part.ends = {ends[0], best};
      add(part);
      part.ends = {best, ends[1]};
      add(part);
    }
  }

  [[nodiscard]] static bool holds(const Box& box, const Point& p) {
    for (std::size_t k = 0; k < 3; ++k)
      if (p[k] < box.low[k] || p[k] > box.high[k]) return false;
    return true;
  }

  [[nodiscard]] bool has_room(const AtSide& here, double more) const {
    return std::all_of(here.facets.begin(), here.facets.end(),
                       [&](Index f) { return !facets_[f].lives || facets_[f].bent + more <= room_; }) &&
           std::all_of(here.segments.begin(), here.segments.end(),
                       [&](Index s) { return !segments_[s].lives || segments_[s].bent + more <= room_; });
  }

  void bend_facet(Index f) {
    if (!facets_[f].lives) return;
    const LocalFacet facet = facets_[f];
    const auto& [a, b, c] = facet.corners;
    for (const Index list : facet.lists)
      for (const Index v : near_[list]) {
        if (v == a || v == b || v == c) continue;
        const Nearness near = beside_facet(at(v), at(a), at(b), at(c));
        if (!(near.distance <= gap_) || !(facet.bent + near.bound() <= room_)) continue;
        end(f);
        for (std::size_t i = 0; i < 3; ++i) {
          LocalFacet part = facet;
          part.corners[i] = v;
          part.bent += near.bound();
          add(std::move(part));
        }
        return;
      }
  }

  void deliver() {
    std::vector<std::array<Index, 2>> parts;  // {first origin, in facets_}
    std::vector<std::uint8_t> is_local(state_.facets.size(), 0);
    for (Index k = 0; k < facets_.size(); ++k) {
      for (const Index origin : facets_[k].origins) is_local[origin] = 1;
      if (facets_[k].lives) parts.push_back({facets_[k].origins[0], k});
    }
    std::sort(parts.begin(), parts.end());
    auto part = parts.begin();
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
      if (has_repeated_corners(state_.facets[f])) continue;
      if (is_local[f] == 0) {
        take(state_.facets[f], std::array{f});
        continue;
      }
      for (; part != parts.end() && (*part)[0] == f; ++part)
        take(facets_[(*part)[1]].corners, facets_[(*part)[1]].origins);
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
  std::span<const Index> vertices_;
  const double gap_, room_;
  const Step& step_;
  std::vector<std::vector<Index>> near_;  // vertices, by facets and then segments in trouble
  std::vector<std::size_t> looked_at_;    // by lists: the last side for which they were looked at
  std::size_t looked_ = 0;                // sides
  std::vector<LocalFacet> facets_;
  std::vector<LocalSegment> segments_;
  std::size_t living_ = 0;
  std::map<Triangle, Index> facet_with_;                  // by its corners, ascending: the last of them
  std::map<std::pair<Side, Index>, Index> segment_with_;  // by its ends, ascending, and its origin
  std::map<Side, AtSide> at_side_;
  std::set<std::pair<double, Side>> sides_;  // to look at
  std::vector<Index> whole_;                 // facets to look at
  double most_ = 0;
};

}  // namespace

double bend(State& state, const Trouble& trouble, std::span<const Index> vertices, double gap, double room,
            const Step& step) {
  return Bending(state, trouble, vertices, gap, room, step).run();
}

}  // namespace holdfast::repairing
