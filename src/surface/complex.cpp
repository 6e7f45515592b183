// Surface layer: tables of segments and the combinatorial numbers of a complex.
#include "surface/complex.h"

#include <algorithm>
#include <numeric>

#include "mesh/disjoint_sets.h"

namespace holdfast {
namespace {

// A side of a facet (origin = 3 * facet + corner) or a segment (origin = 3 * facets + segment).
struct Side {
  Index low, high;
  std::size_t origin;
};

// Stable counting sort by one of the two ends, O(sides + vertices).
void sort_by(Index Side::*end, std::size_t vertices, const std::vector<Side>& from, std::vector<Side>& to) {
  std::vector<std::size_t> first(vertices + 1, 0);
  for (const Side& side : from) ++first[side.*end + std::size_t{1}];
  std::partial_sum(first.begin(), first.end(), first.begin());
  for (const Side& side : from) to[first[side.*end]++] = side;
}

// All sides and segments in lexicographic order; equal ones in the order of their origins.
std::vector<Side> sorted_sides(const Complex& complex) {
  std::vector<Side> sides;
  sides.reserve(3 * complex.facets.size() + complex.segments.size());
  const auto add = [&sides](Index a, Index b) {
    sides.push_back({std::min(a, b), std::max(a, b), sides.size()});
  };
  for (const Triangle& t : complex.facets) {
    for (unsigned i = 0; i < 3; ++i) add(t[(i + 1) % 3], t[(i + 2) % 3]);
  }
  for (const Segment& s : complex.segments) add(s[0], s[1]);
  std::vector<Side> other(sides.size());
  sort_by(&Side::high, complex.vertices.size(), sides, other);
  sort_by(&Side::low, complex.vertices.size(), other, sides);
  return sides;
}

// Peels facets with a side that no other facet has, until there is none; returns their number.
std::size_t peel_from_borders(const SegmentTable& table) {
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
  std::size_t peeled = 0;
  while (!stack.empty()) {
    const Index f = stack.back();
    stack.pop_back();
    if (gone[f]) continue;
    gone[f] = 1;
    ++peeled;
    for (const Index s : table.facet_segments[f]) {
      if (--left[s] == 1) push_facet_left_at(s);
    }
  }
  return peeled;
}

}  // namespace

Index SegmentTable::find(Index a, Index b) const {
  const auto [low, high] = std::minmax(a, b);
  if (low + std::size_t{1} >= first_of_vertex.size()) return no_index;
  const auto begin = segments.begin() + first_of_vertex[low];
  const auto end = segments.begin() + first_of_vertex[low + std::size_t{1}];
  const auto at =
      std::lower_bound(begin, end, high, [](const Segment& s, Index wanted) { return s[1] < wanted; });
  return at != end && (*at)[1] == high ? static_cast<Index>(at - segments.begin()) : no_index;
}

bool has_indices_in_range(const Complex& complex) {
  const auto are_in_range = [&](const auto& corners) {
    return std::all_of(corners.begin(), corners.end(), [&](Index v) { return v < complex.vertices.size(); });
  };
  return std::all_of(complex.facets.begin(), complex.facets.end(), are_in_range) &&
         std::all_of(complex.segments.begin(), complex.segments.end(), are_in_range);
}

SegmentTable segment_table(const Complex& complex) {
  const std::vector<Side> sides = sorted_sides(complex);
  const std::size_t facet_sides = 3 * complex.facets.size();
  SegmentTable table;
  table.facet_segments.resize(complex.facets.size());
  table.facets.reserve(facet_sides);
  for (const Side& side : sides) {
    const Segment ends{side.low, side.high};
    if (table.segments.empty() || table.segments.back() != ends) {
      table.first_of_vertex.resize(side.low + std::size_t{1}, static_cast<Index>(table.segments.size()));
      table.segments.push_back(ends);
      table.first_facet.push_back(static_cast<Index>(table.facets.size()));
      table.input_segment.push_back(no_index);
    }
    if (side.origin < facet_sides) {
      const auto facet = static_cast<Index>(side.origin / 3);
      table.facets.push_back(facet);
      table.facet_segments[facet][side.origin % 3] = static_cast<Index>(table.segments.size() - 1);
    } else if (table.input_segment.back() == no_index) {
      table.input_segment.back() = static_cast<Index>(side.origin - facet_sides);
    }
  }
  table.first_facet.push_back(static_cast<Index>(table.facets.size()));
  table.first_of_vertex.resize(complex.vertices.size() + 1, static_cast<Index>(table.segments.size()));
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
  topology.dangling_facets = peel_from_borders(table);
  return topology;
}

}  // namespace holdfast
