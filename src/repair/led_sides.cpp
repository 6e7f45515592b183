#include "repair/led_sides.h"

#include <algorithm>

#include "numbers/sorted.h"
#include "surface/box_pairs.h"
#include "surface/complex.h"

namespace holdfast::repairing {

LedSides::LedSides(const PartFacets& facets, std::span<const Index> close, double gap,
                   std::vector<Point>& vertices, const Step& step)
    : facets_(facets), gap_(gap) {
  list(close);
  put_vertices(close, step);
  cross_sides(vertices, step);
  for (auto& [side, on] : sides_) std::sort(on.points.begin(), on.points.end());
  for (auto& [side, on] : sides_) part_from_itself(side, on);
}

void LedSides::list(std::span<const Index> close) {
  for (const Index f : close)
    for (std::size_t i = 0; i < 3; ++i) {
      const Triangle& t = facets_.corners(f);
      sides_[ascending(Side{t[i], t[(i + 1) % 3]})].parts.push_back(facets_.part_of(f));
    }
  for (auto& [side, on] : sides_) sort_unique(on.parts);
}

bool LedSides::meet(const std::vector<Index>& a, const std::vector<Index>& b) {
  return std::any_of(a.begin(), a.end(), [&](Index p) { return std::binary_search(b.begin(), b.end(), p); });
}

// Each vertex goes to the nearest of a part's sides near it.
void LedSides::put_vertices(std::span<const Index> close, const Step& step) {
  std::vector<Index> vertices;
  for (const Index f : close)
    vertices.insert(vertices.end(), facets_.corners(f).begin(), facets_.corners(f).end());
  sort_unique(vertices);
  std::vector<Box> round_vertices, round_sides;
  std::vector<Sides::iterator> sides;
  for (const Index v : vertices) round_vertices.push_back(box_round(facets_.state(), std::array{v}, gap_));
  for (auto side = sides_.begin(); side != sides_.end(); ++side) {
    sides.push_back(side);
    round_sides.push_back(box_round(facets_.state(), side->first, 0));
  }
  NearestSides nearest;
  const auto compare = [&](Index i, Index j) {
    note_nearness(vertices[i], sides[j], nearest);
    return true;
  };
  for_each_overlap_between(std::move(round_vertices), round_sides, compare, step);

  for (const auto& [key, found] : nearest) {
    on_side_.insert(key);
    auto& points = found.side->second.points;
    const std::pair<double, Index> point{found.t, key.first};
    if (std::find(points.begin(), points.end(), point) == points.end()) points.push_back(point);
    most_ = std::max(most_, found.distance);
  }
}

void LedSides::note_nearness(Index v, Sides::iterator side, NearestSides& nearest) const {
  const auto [a, b] = side->first;
  if (v == a || v == b || meet(facets_.parts_at(v), side->second.parts)) return;
  const Nearness near = beside_side(at(v), at(a), at(b));
  if (!(near.distance <= gap_) || is_led_back(v, a) || is_led_back(v, b)) return;
  for (const Index p : side->second.parts) {
    const NearSide found{near.distance, near.t, side};
    const auto [there, is_new] = nearest.try_emplace({v, p}, found);
    const NearSide& known = there->second;
    if (!is_new && std::pair(near.distance, side->first) < std::pair(known.distance, known.side->first))
      there->second = found;
  }
}

// Two vertices within the gap may each pass a side of the other; then the later vertex goes on the side.
bool LedSides::is_led_back(Index v, Index end) const { return v < end && length(at(v) - at(end)) <= gap_; }

bool LedSides::has(const Side& side, const OnSide& on, Index v) {
  return v == side[0] || v == side[1] ||
         std::any_of(on.points.begin(), on.points.end(), [&](const auto& p) { return p.second == v; });
}

// Whether two sides now share a vertex: then they meet there and nowhere else.
bool LedSides::are_joined(const Side& s, const OnSide& on_s, const Side& t, const OnSide& on_t) {
  if (has(s, on_s, t[0]) || has(s, on_s, t[1])) return true;
  return has(t, on_t, s[0]) || has(t, on_t, s[1]) ||
         std::any_of(on_s.points.begin(), on_s.points.end(),
                     [&](const auto& p) { return has(t, on_t, p.second); });
}

void LedSides::cross_sides(std::vector<Point>& vertices, const Step& step) {
  std::vector<Box> boxes;
  std::vector<Sides::iterator> sides;
  for (auto side = sides_.begin(); side != sides_.end(); ++side) {
    sides.push_back(side);
    boxes.push_back(box_round(facets_.state(), side->first, gap_ / 2));
  }
  std::vector<Crossing> crossings;
  AabbTree(boxes).for_each_overlap(
      [&](Index i, Index j) {
        if (i > j) std::swap(i, j);
        const auto& [s, on_s] = *sides[i];
        const auto& [t, on_t] = *sides[j];
        if (meet(on_s.parts, on_t.parts) || are_joined(s, on_s, t, on_t)) return true;
        const bool earlier = on_s.parts[0] < on_t.parts[0];  // the part whose side gets the new vertex
        const Passing passing = pass(at(s[0]), at(s[1]), at(t[0]), at(t[1]));
        if (!(passing.distance <= gap_)) return true;
        crossings.push_back({i, j, passing.t, passing.s, earlier ? passing.on_first : passing.on_second});
        most_ = std::max(most_, passing.distance);
        return true;
      },
      [](Index, Index) { return false; }, step);
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  });
  for (const Crossing& crossing : crossings)
    join_at(crossing, *sides[crossing.first], *sides[crossing.second], vertices);
}

// Gives two sides a common vertex at their crossing. If three sides meet in a point, two of them found it
// first.
void LedSides::join_at(const Crossing& crossing, Sides::value_type& first, Sides::value_type& second,
                       std::vector<Point>& vertices) const {
  auto& [s, on_s] = first;
  auto& [t, on_t] = second;
  Index v = near_on(s, on_s, crossing.where, t);
  if (v == no_index) v = near_on(t, on_t, crossing.where, s);
  if (v == no_index) {
    v = static_cast<Index>(vertices.size());
    vertices.push_back(crossing.where);
  }
  if (!has(s, on_s, v)) on_s.points.emplace_back(crossing.t, v);
  if (!has(t, on_t, v)) on_t.points.emplace_back(crossing.s, v);
}

// A vertex of one side near its crossing with another side may still be too far from the other side.
Index LedSides::near_on(const Side& side, const OnSide& on, const Point& p, const Side& other) const {
  const auto is_near = [&](Index v) { return length(at(v) - p) <= gap_ && distance(v, other) <= gap_; };
  for (const Index v : side)
    if (is_near(v)) return v;
  for (const auto& [t, v] : on.points)
    if (is_near(v)) return v;
  return no_index;
}

double LedSides::distance(Index v, const Side& side) const {
  const auto [a, b] = side;
  return std::min({beside_side(at(v), at(a), at(b)).distance, length(at(v) - at(a)), length(at(v) - at(b))});
}

// A piece of a side may itself be a side that is led through vertices. If this would lead back to the first
// side, a vertex is left out.
void LedSides::part_from_itself(const Side& side, OnSide& on) {
  if (on.state == OnSide::done || on.points.empty()) return;
  on.state = OnSide::open;
  for (std::size_t k = 0; k <= on.points.size();) {
    const Index a = k == 0 ? side[0] : on.points[k - 1].second;
    const Index b = k == on.points.size() ? side[1] : on.points[k].second;
    const auto piece = sides_.find(ascending(Side{a, b}));
    if (piece != sides_.end() && piece->second.state == OnSide::open) {
      on.points.erase(on.points.begin() + static_cast<std::ptrdiff_t>(k == 0 ? 0 : k - 1));
      if (on.points.empty()) break;
      k = k == 0 ? 0 : k - 1;
      continue;
    }
    if (piece != sides_.end()) part_from_itself(piece->first, piece->second);
    ++k;
  }
  on.state = OnSide::done;
}

std::vector<Index> LedSides::chain(Index from, Index to) const {
  std::vector<Index> chain{from};
  append(from, to, chain);
  return chain;
}

std::vector<LedSides::Side> LedSides::round(const Triangle& t) const {
  std::vector<Side> round;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::vector<Index> along = chain(t[i], t[(i + 1) % 3]);
    for (std::size_t k = 0; k + 1 < along.size(); ++k) round.push_back({along[k], along[k + 1]});
  }
  return round;
}

// Pieces that are sides themselves are led as those sides are.
void LedSides::append(Index from, Index to, std::vector<Index>& chain, int depth) const {
  constexpr int kDeepest = 24;
  const auto found = sides_.find(ascending(Side{from, to}));
  if (found == sides_.end() || found->second.points.empty() || depth > kDeepest) {
    chain.push_back(to);
    return;
  }
  std::vector<Index> on;
  for (const auto& [t, v] : found->second.points) on.push_back(v);
  if (from > to) std::reverse(on.begin(), on.end());
  on.push_back(to);
  for (const Index v : on) append(chain.back(), v, chain, depth + 1);
}

std::vector<Triangle> LedSides::split(const Triangle& t) const {
  std::vector<Triangle> pieces;
  if (!split_deeper(t, pieces, 0)) pieces = fan(t);
  // Two pieces with the same corners are folded onto each other and bound nothing.
  std::sort(pieces.begin(), pieces.end(),
            [](const Triangle& a, const Triangle& b) { return ascending(a) < ascending(b); });
  std::size_t kept = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (kept > 0 && ascending(pieces[kept - 1]) == ascending(pieces[k]))
      --kept;
    else
      pieces[kept++] = pieces[k];
  }
  pieces.resize(kept);
  return pieces;
}

// Triangles between a corner and all pieces of sides. They may be folded, but they leave no crack.
std::vector<Triangle> LedSides::fan(const Triangle& t) const {
  std::vector<Triangle> fan;
  for (const Side& side : round(t))
    if (side[0] != t[0] && side[1] != t[0]) fan.push_back({t[0], side[0], side[1]});
  return fan;
}

bool LedSides::split_deeper(const Triangle& t, std::vector<Triangle>& pieces, int depth) const {
  constexpr int kDeepest = 24;  // each level completes a side
  if (depth > kDeepest) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Index a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
    const std::vector<Index> along = chain(a, b);
    if (along.size() == 2) continue;
    for (std::size_t k = 0; k + 1 < along.size(); ++k)
      if (along[k] != c && along[k + 1] != c && !split_deeper({along[k], along[k + 1], c}, pieces, depth + 1))
        return false;
    return true;
  }
  pieces.push_back(t);
  return true;
}

}  // namespace holdfast::repairing
