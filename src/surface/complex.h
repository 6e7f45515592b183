// Surface layer: the complex as segments (edges of the input) and the facets round each of them.
//
// "Segment" is used for every edge that the mesh must hold: the sides of all facets and the
// complex's own segments, merged. Nothing here looks at coordinates; the tables are built by two
// stable counting sorts, so that their order depends on the complex alone.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "holdfast/types.h"
#include "mesh/parallel.h"

namespace holdfast {

/// "No such entity" in tables of indices.
inline constexpr Index no_index = ~Index{0};

/// Every edge of a complex, once, with the facets round it.
struct SegmentTable {
  /// Vertex pairs with the lesser index first, in lexicographic order.
  std::vector<Segment> segments;
  /// facet_segments[f][i] is the segment opposite corner i of facet f, in `segments`.
  std::vector<std::array<Index, 3>> facet_segments;
  /// CSR: the facets round segment s are facets[first_facet[s]] .. facets[first_facet[s + 1] - 1],
  /// in ascending order. `first_facet` has one entry more than `segments`.
  std::vector<Index> first_facet;
  std::vector<Index> facets;
  /// The first of the complex's own segments that is this one, or `no_index` for mere sides.
  std::vector<Index> input_segment;
  /// The index in `segments` where the segments whose lesser end is vertex v begin; one entry more than
  /// vertices.
  std::vector<Index> first_of_vertex;

  /// Facets round segment `s`.
  [[nodiscard]] std::span<const Index> facets_of(Index s) const {
    return {facets.data() + first_facet[s], facets.data() + first_facet[s + 1]};
  }
  /// Index of the segment with ends `a` and `b` in any order, or `no_index`, which is also returned for ends
  /// that are not vertices of the complex. O(log of the segments at the lesser end).
  [[nodiscard]] Index find(Index a, Index b) const;
};

/// Whether every facet and segment names existing vertices.
[[nodiscard]] bool has_indices_in_range(const Complex& complex);

/// Builds the table in O(vertices + facets + segments), plus the time to sort the segments at each vertex.
///
/// Every index must be in range. Facets and segments that name a vertex twice give segments with equal ends
/// (callers refuse those first: see surface/diagnose.h). One thread builds the table, and polls.
[[nodiscard]] SegmentTable segment_table(const Complex& complex, const Threads& polled = {});

/// Peels off facets with a side that no other facet has, until there are none. For each facet, whether it was
/// peeled off.
[[nodiscard]] std::vector<char> peeled_from_borders(const SegmentTable& table);

/// How the complex is connected; combinatorial numbers only.
struct SurfaceTopology {
  std::size_t vertices = 0, facets = 0;
  std::size_t segments = 0;              ///< in the table: sides and the complex's own, merged
  std::size_t components = 0;            ///< connected by sides and segments; an isolated vertex is one
  std::size_t isolated_vertices = 0;     ///< used by no facet and no segment
  std::size_t dangling_segments = 0;     ///< of no facet
  std::size_t border_segments = 0;       ///< of one facet
  std::size_t nonmanifold_segments = 0;  ///< of three facets or more
  std::size_t odd_segments = 0;          ///< of an odd number of facets, border included
  /// Facets that disappear when facets with a border side are peeled off until there are none. They bound no
  /// region, whatever the coordinates: the same region lies on both sides.
  std::size_t dangling_facets = 0;
  /// There are facets, and each of their sides belongs to another facet too.
  bool closed = false;
};

[[nodiscard]] SurfaceTopology surface_topology(const Complex& complex, const SegmentTable& table);

}  // namespace holdfast
