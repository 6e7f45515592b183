// Surface layer: tables of segments and the combinatorial numbers of a complex.
#include "surface/complex.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "mesh/disjoint_sets.h"

namespace holdfast {
namespace {

constexpr Index kOwn = 3;
constexpr std::size_t kPolledTurns = 1u << 14;  // a few milliseconds' work

// A side of a facet, opposite a corner, or a segment of the complex, stored at its lesser end.
struct Side {
  Index high, item, corner;  // `corner` is kOwn for a segment

  friend bool operator<(const Side& x, const Side& y) {
    return std::tuple(x.high, x.corner == kOwn, x.item, x.corner) <
           std::tuple(y.high, y.corner == kOwn, y.item, y.corner);
  }
};

// Calls act(lesser end, side).
template <typename Act>
void for_each_side(const Complex& complex, Act&& act) {
  const auto tell = [&](Index a, Index b, Index item, Index corner) {
    act(std::min(a, b), Side{std::max(a, b), item, corner});
  };
  for (Index f = 0; f < complex.facets.size(); ++f) {
    const Triangle& t = complex.facets[f];
    for (Index i = 0; i < 3; ++i) tell(t[(i + 1) % 3], t[(i + 2) % 3], f, i);
  }
  for (Index s = 0; s < complex.segments.size(); ++s)
    tell(complex.segments[s][0], complex.segments[s][1], s, kOwn);
}

// All sides by their lesser ends: those of v are sides[first[v]] .. sides[first[v + 1] - 1], in ascending
// order. Each vertex has few, so the caches hold what is sorted.
struct SortedSides {
  std::vector<std::size_t> first;
  std::vector<Side> sides;

  SortedSides(const Complex& complex, const Threads& polled)
      : first(complex.vertices.size() + 1, 0), sides(3 * complex.facets.size() + complex.segments.size()) {
    for_each_side(complex, [&](Index low, const Side&) { ++first[low]; });
    std::inclusive_scan(first.begin(), first.end(), first.begin());
    polled.poll();
    for_each_side(complex, [&](Index low, const Side& side) { sides[--first[low]] = side; });
    for (std::size_t v = 0; v < complex.vertices.size(); ++v) {
      if (v % kPolledTurns == 0) polled.poll();
      const auto at = [&](std::size_t k) { return sides.begin() + static_cast<std::ptrdiff_t>(first[k]); };
      std::sort(at(v), at(v + 1));
    }
  }
  /// The number of different pairs of ends.
  [[nodiscard]] std::size_t segment_count() const {
    std::size_t count = 0;
    for (std::size_t v = 0; v + 1 < first.size(); ++v)
      for (std::size_t k = first[v]; k < first[v + 1]; ++k)
        count += k == first[v] || sides[k].high != sides[k - 1].high ? 1 : 0;
    return count;
  }
};

}  // namespace

std::vector<char> peeled_from_borders(const SegmentTable& table) {
  std::vector<Index> left(table.segments.size());
  std::vector<Index> stack;
  std::vector<char> gone(table.facet_segments.size(), 0);
  const auto push_facet_left_at = [&](Index segment) {
    for (const Index f : table.facets_of(segment)) {
      if (!gone[f]) stack.push_back(f);
    }
  };
  for (Index s = 0; s < left.size(); ++s) {
    left[s] = static_cast<Index>(table.facets_of(s).size());
    if (left[s] == 1) push_facet_left_at(s);
  }
  while (!stack.empty()) {
    const Index f = stack.back();
    stack.pop_back();
    if (gone[f]) continue;
    gone[f] = 1;
    for (const Index s : table.facet_segments[f]) {
      if (--left[s] == 1) push_facet_left_at(s);
    }
  }
  return gone;
}

Index SegmentTable::find(Index a, Index b) const {
  const auto [low, high] = std::minmax(a, b);
  if (low + std::size_t{1} >= first_of_vertex.size()) return no_index;
  const auto begin = segments.begin() + first_of_vertex[low];
  const auto end = segments.begin() + first_of_vertex[low + std::size_t{1}];
  const auto is_below = [high = high](const Segment& s) { return s[1] < high; };
  // Mostly there are three, for which a binary search would be mispredicted.
  constexpr std::ptrdiff_t kFew = 8;
  const auto at = end - begin <= kFew ? begin + std::count_if(begin, end, is_below)
                                      : std::partition_point(begin, end, is_below);
  return at != end && (*at)[1] == high ? static_cast<Index>(at - segments.begin()) : no_index;
}

bool has_indices_in_range(const Complex& complex) {
  const auto are_in_range = [&](const auto& corners) {
    return std::all_of(corners.begin(), corners.end(), [&](Index v) { return v < complex.vertices.size(); });
  };
  return std::all_of(complex.facets.begin(), complex.facets.end(), are_in_range) &&
         std::all_of(complex.segments.begin(), complex.segments.end(), are_in_range);
}

SegmentTable segment_table(const Complex& complex, const Threads& polled) {
  const SortedSides sorted(complex, polled);
  const std::size_t count = sorted.segment_count();
  polled.poll();
  SegmentTable table;
  table.segments.reserve(count);
  table.first_facet.reserve(count + 1);
  table.input_segment.reserve(count);
  table.first_of_vertex.reserve(sorted.first.size());
  table.facets.reserve(3 * complex.facets.size());
  table.facet_segments.resize(complex.facets.size());
  for (Index low = 0; low < complex.vertices.size(); ++low) {
    if (low % kPolledTurns == 0) polled.poll();
    table.first_of_vertex.push_back(static_cast<Index>(table.segments.size()));
    for (std::size_t k = sorted.first[low]; k < sorted.first[low + std::size_t{1}]; ++k) {
      const Side& side = sorted.sides[k];
      if (k == sorted.first[low] || side.high != sorted.sides[k - 1].high) {
        table.segments.push_back({low, side.high});
        table.first_facet.push_back(static_cast<Index>(table.facets.size()));
        table.input_segment.push_back(no_index);
      }
      if (side.corner != kOwn) {
        table.facets.push_back(side.item);
        table.facet_segments[side.item][side.corner] = static_cast<Index>(table.segments.size() - 1);
      } else if (table.input_segment.back() == no_index) {
        table.input_segment.back() = side.item;
      }
    }
  }
  table.first_of_vertex.push_back(static_cast<Index>(table.segments.size()));
  table.first_facet.push_back(static_cast<Index>(table.facets.size()));
  return table;
}

SurfaceTopology surface_topology(const Complex& complex, const SegmentTable& table) {
  SurfaceTopology topology;
  topology.vertices = complex.vertices.size();
  topology.facets = complex.facets.size();
  topology.segments = table.segments.size();
  topology.components = topology.vertices;
  DisjointSets sets(topology.vertices);
  std::vector<char> used(topology.vertices, 0);
  for (Index s = 0; s < table.segments.size(); ++s) {
    const auto [a, b] = table.segments[s];
    used[a] = used[b] = 1;
    if (sets.unite(a, b)) --topology.components;
    const std::size_t facets = table.facets_of(s).size();
    topology.dangling_segments += facets == 0;
    topology.border_segments += facets == 1;
    topology.nonmanifold_segments += facets > 2;
    topology.odd_segments += facets % 2;
  }
  topology.isolated_vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), 0));
  topology.closed = topology.facets > 0 && topology.border_segments == 0;
  const std::vector<char> peeled = peeled_from_borders(table);
  topology.dangling_facets = static_cast<std::size_t>(std::count(peeled.begin(), peeled.end(), 1));
  return topology;
}

}  // namespace holdfast
