// Surface layer: vertices that lie almost on others.
#include "surface/gaps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "numbers/elementary.h"
#include "numbers/finite.h"
#include "numbers/sorted.h"
#include "surface/aabb_tree.h"

namespace holdfast {
namespace {

/// Part of the shortest edge at a vertex within which another vertex looks like the same one. Wide enough for
/// gaps that people overlook, too narrow for modelled details.
constexpr double kReach = 0.02;

/// The distance of p from the nearest point of ab, and that point's parameter: 0 at a, 1 at b.
std::pair<double, double> from_side(const Point& p, const Point& a, const Point& b) {
  double along = 0, square = 0;
  const double length = numbers::distance(a, b);
  for (unsigned k = 0; k < 3; ++k) {
    const double direction = (b[k] - a[k]) / length;
    along += (p[k] - a[k]) * direction;
    square += direction * direction;
  }
  const double t = std::clamp(along / (square * length), 0.0, 1.0);
  const Point foot{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
  return {numbers::distance(p, foot), t};
}

}  // namespace

GapFinder::GapFinder(const Complex& complex, const SegmentTable& table)
    : complex_(complex), table_(table), reach_(complex.vertices.size(), 0) {
  for (const auto& [a, b] : table.segments) {
    const double length = numbers::distance(complex.vertices[a], complex.vertices[b]);
    if (!(length > 0) || !std::isfinite(length)) continue;
    for (const Index v : {a, b}) {
      const double reach = kReach * length;
      reach_[v] = reach_[v] == 0 ? reach : std::min(reach_[v], reach);
    }
  }
}

std::optional<Nearness> GapFinder::between(Index v, Index side) const {
  const auto [a, b] = table_.segments[side];
  const Point& p = complex_.vertices[v];
  const Triangle& own = complex_.facets[table_.facets_of(side)[0]];
  if (v == a || v == b || std::find(own.begin(), own.end(), v) != own.end()) return std::nullopt;
  const auto [off, at] = from_side(p, complex_.vertices[a], complex_.vertices[b]);
  if (!(off <= reach(v))) return std::nullopt;
  for (const Index end : {a, b}) {
    const double apart = numbers::distance(p, complex_.vertices[end]);
    if (apart <= std::min(reach(v), reach(end))) return Nearness{v, {end, end}, apart};
  }
  if (at == 0 || at == 1) return std::nullopt;
  return Nearness{v, {a, b}, off};
}

std::vector<Nearness> GapFinder::between_borders() const {
  std::vector<Index> sides, vertices;
  for (Index s = 0; s < table_.segments.size(); ++s) {
    const auto [a, b] = table_.segments[s];
    if (table_.facets_of(s).size() != 1 || !is_finite(complex_.vertices[a]) ||
        !is_finite(complex_.vertices[b]))
      continue;
    sides.push_back(s);
    vertices.insert(vertices.end(), {a, b});
  }
  sort_unique(vertices);

  std::vector<Box> boxes;
  for (const Index s : sides) {
    const Point &a = complex_.vertices[table_.segments[s][0]], &b = complex_.vertices[table_.segments[s][1]];
    Box box{a, a};
    box.extend({b, b});
    boxes.push_back(box);
  }
  for (const Index v : vertices) {
    Box box{complex_.vertices[v], complex_.vertices[v]};
    for (unsigned k = 0; k < 3; ++k) {
      constexpr double kMost = std::numeric_limits<double>::max();
      box.low[k] = std::max(box.low[k] - reach(v), -kMost);
      box.high[k] = std::min(box.high[k] + reach(v), kMost);
    }
    boxes.push_back(box);
  }

  std::map<Index, Nearness> nearest;
  const auto visit = [&](Index i, Index j) {
    const auto [side, vertex] = std::minmax(i, j);
    if (side >= sides.size() || vertex < sides.size()) return true;
    const std::optional<Nearness> found = between(vertices[vertex - sides.size()], sides[side]);
    if (!found || found->distance == 0) return true;
    const auto [at, is_new] = nearest.try_emplace(found->vertex, *found);
    if (!is_new && found->distance < at->second.distance) at->second = *found;
    return true;
  };
  const AabbTree tree(boxes);
  tree.for_each_overlap(
      visit, [](Index, Index) { return false; }, [](double) {});

  std::vector<Nearness> gaps;
  for (const auto& [vertex, gap] : nearest) {
    // Two vertices close to each other are reported once.
    const Index other = gap.other[0];
    const bool mutual = gap.other[0] == gap.other[1] && nearest.contains(other) &&
                        nearest.at(other).other == Segment{vertex, vertex};
    if (!mutual || vertex < other) gaps.push_back(gap);
  }
  return gaps;
}

std::optional<Nearness> GapFinder::among(std::span<const Index> vertices) const {
  std::optional<Nearness> nearest;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (std::size_t j = i + 1; j < vertices.size(); ++j) {
      const auto [a, b] = std::minmax(vertices[i], vertices[j]);
      const double apart = numbers::distance(complex_.vertices[a], complex_.vertices[b]);
      // Ends of one edge are farther apart than this.
      if (apart > 0 && apart <= std::min(reach(a), reach(b)) && (!nearest || apart < nearest->distance))
        nearest = Nearness{a, {b, b}, apart};
    }
  return nearest;
}

}  // namespace holdfast
