// The description of a repaired surface for the caller.
#include "repair/deliver.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "exact/dyadic.h"
#include "exact/space_point.h"
#include "numbers/finite.h"
#include "numbers/sorted.h"
#include "surface/complex.h"
#include "surface/intersect.h"
#include "surface/places.h"

namespace holdfast::repairing {
namespace {

/// One marker for each set of parents' markers: the marker itself if the set has only one, else the next free
/// number.
class MarkerSets {
 public:
  MarkerSets(std::span<const int> markers, const std::map<int, std::string>& names)
      : used_(markers.begin(), markers.end()) {
    for (const auto& [id, name] : names) used_.insert(id);
  }

  int marker_of(std::vector<int> set) {
    sort_unique(set);
    if (set.size() == 1) return set[0];
    const auto [at, is_new] = number_.try_emplace(std::move(set), 0);
    if (is_new) used_.insert(at->second = next_free());
    return at->second;
  }

  [[nodiscard]] std::map<int, std::vector<int>> sets() const {
    std::map<int, std::vector<int>> sets;
    for (const auto& [set, number] : number_) sets[number] = set;
    return sets;
  }

  /// A set of named markers gets the joined name, `rim+root`, if all have names.
  void name(std::map<int, std::string>& names) const {
    for (const auto& [set, number] : number_) {
      std::string name;
      for (const int marker : set) {
        const auto of = names.find(marker);
        if (of == names.end()) {
          name.clear();
          break;
        }
        name += (name.empty() ? "" : "+") + of->second;
      }
      if (!name.empty()) names[number] = name;
    }
  }

 private:
  [[nodiscard]] int next_free() const {
    int id = std::max(0, *used_.rbegin());
    if (id == std::numeric_limits<int>::max())  // from now on, the first gap
      for (id = 0; used_.contains(id + 1);) ++id;
    return id + 1;
  }

  std::set<int> used_;
  std::map<std::vector<int>, int> number_;
};

void mark_facets(std::span<const int> markers, RepairResult& result) {
  if (markers.empty()) return;
  std::map<int, std::string>& names = result.surface.names.facets;
  MarkerSets sets(markers, names);
  std::vector<int> set;
  for (std::size_t f = 0; f < result.surface.facets.size(); ++f) {
    set.clear();
    for (const Index p : result.parents[f]) set.push_back(markers[p]);
    if (set.empty()) set.push_back(0);  // fills a hole
    result.surface.facet_markers.push_back(sets.marker_of(set));
  }
  result.marker_sets = sets.sets();
  sets.name(names);
}

/// Segments carry the marker of their first parent.
void mark_segments(std::span<const int> markers, RepairResult& result) {
  if (markers.empty()) return;
  for (std::size_t s = 0; s < result.surface.segments.size(); ++s)
    result.surface.segment_markers.push_back(markers[result.segment_parents[s][0]]);
}

void mark_vertices(std::span<const int> markers, RepairResult& result) {
  if (markers.empty()) return;
  result.surface.vertex_markers.assign(markers.begin(), markers.end());
  result.surface.vertex_markers.resize(result.surface.vertices.size(), 0);
}

/// The least double that is not below the distance of two points.
double displacement_of(const Point& p, const Point& q) {
  exact::Dyadic square;
  for (std::size_t k = 0; k < 3; ++k) {
    const exact::Dyadic difference = exact::Dyadic(p[k]) - exact::Dyadic(q[k]);
    square += difference * difference;
  }
  double distance = exact::distance_bound(exact::space_point(p.data()), q.data());
  for (;;) {
    const double below = std::nextafter(distance, 0.0);
    if (!std::isfinite(below) || exact::Dyadic(below) * exact::Dyadic(below) < square) return distance;
    distance = below;
  }
}

/// A vertex that stays at its place keeps its bits: it may have been joined with a vertex whose zeros have
/// other signs.
void list_moved(const Complex& input, RepairResult& result) {
  for (Index v = 0; v < input.vertices.size(); ++v) {
    const Point& before = input.vertices[v];
    Point& after = result.surface.vertices[v];
    if (!is_finite(before)) continue;
    if (before == after) {
      after = before;
      continue;
    }
    const double distance = displacement_of(before, after);
    result.moved.push_back({v, distance});
    result.max_displacement = std::max(result.max_displacement, distance);
  }
}

DropReason reason_of(const Complex& input, Index f, bool has_united) {
  const Triangle& t = input.facets[f];
  Simplex facet;
  for (std::size_t i = 0; i < 3; ++i) {
    if (t[i] >= input.vertices.size() || !is_finite(input.vertices[t[i]])) return DropReason::not_finite;
    facet.point[i] = input.vertices[t[i]].data();
  }
  if (!set_projection(facet)) return DropReason::no_area;
  return has_united ? DropReason::inner : DropReason::vanished;
}

void list_dropped(const Complex& input, bool has_united, RepairResult& result) {
  std::vector<std::uint8_t> has_child(input.facets.size(), 0);
  for (const Index p : result.parents.all) has_child[p] = 1;
  for (Index f = 0; f < input.facets.size(); ++f)
    if (has_child[f] == 0) result.dropped.push_back({f, reason_of(input, f, has_united)});
}

void list_merged(const Complex& input, RepairResult& result) {
  const std::vector<Index> first = first_at_places(input.vertices);
  std::map<Triangle, Index> first_with;
  std::vector<std::uint8_t> seen(input.facets.size(), 0);
  std::vector<Index> candidates;
  for (std::size_t f = 0; f < result.parents.size(); ++f) {
    if (result.parents[f].size() < 2) continue;
    for (const Index p : result.parents[f])
      if (std::exchange(seen[p], std::uint8_t{1}) == 0) candidates.push_back(p);
  }
  std::sort(candidates.begin(), candidates.end());
  for (const Index p : candidates) {
    const Triangle& t = input.facets[p];
    const auto [at, is_new] =
        first_with.try_emplace(ascending(Triangle{first[t[0]], first[t[1]], first[t[2]]}), p);
    if (!is_new) result.merged.push_back({p, at->second});
  }
}

}  // namespace

void deliver(const Complex& input, Rounded rounded, RepairResult& result) {
  result.surface.vertices = std::move(rounded.state.vertices);
  result.surface.facets = std::move(rounded.state.facets);
  result.surface.segments = std::move(rounded.state.segments);
  result.parents = lists_of(rounded.state.facet_parents);
  result.segment_parents = lists_of(rounded.state.segment_parents);
  result.max_displacement = rounded.displacement;
  if (input.names != nullptr) result.surface.names = *input.names;
  mark_facets(input.facet_markers, result);
  mark_segments(input.segment_markers, result);
  mark_vertices(input.vertex_markers, result);
  list_moved(input, result);
  list_dropped(input, rounded.has_united, result);
  list_merged(input, result);
  for (std::size_t f = 0; f < result.surface.facets.size(); ++f) {
    const auto parents = result.parents[f];
    const bool whole = parents.size() == 1 && input.facets[parents[0]] == result.surface.facets[f];
    if (!whole) ++result.report.changed_facets;
  }
}

}  // namespace holdfast::repairing
