// The table of segments and the combinatorial numbers of a complex.
#include <gtest/gtest.h>

#include <algorithm>

#include "surface/complex.h"

namespace holdfast::surface_complex_test {
namespace {

Surface tetrahedron() {
  Surface s;
  s.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  s.facets = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return s;
}

SurfaceTopology topology_of(const Surface& s) { return surface_topology(s.view(), segment_table(s.view())); }

TEST(SegmentTable, TetrahedronHasSixSegmentsOfTwoFacets) {
  const Surface s = tetrahedron();
  const SegmentTable table = segment_table(s.view());
  const std::vector<Segment> expected{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  EXPECT_EQ(table.segments, expected);
  ASSERT_EQ(table.first_facet.size(), 7u);
  for (Index i = 0; i < 6; ++i) {
    const auto facets = table.facets_of(i);
    EXPECT_EQ(facets.size(), 2u);
    EXPECT_TRUE(std::is_sorted(facets.begin(), facets.end()));
    EXPECT_EQ(table.input_segment[i], no_index);
  }
}

TEST(SegmentTable, IndicesAreInRangeOrNot) {
  Surface s = tetrahedron();
  EXPECT_TRUE(has_indices_in_range(s.view()));
  s.segments = {{0, 4}};
  EXPECT_FALSE(has_indices_in_range(s.view()));
  s.segments.clear();
  s.facets[2][1] = no_index;
  EXPECT_FALSE(has_indices_in_range(s.view()));
}

TEST(SegmentTable, FacetSegmentIsOppositeTheCorner) {
  const Surface s = tetrahedron();
  const SegmentTable table = segment_table(s.view());
  for (std::size_t f = 0; f < s.facets.size(); ++f) {
    for (unsigned i = 0; i < 3; ++i) {
      Segment side{s.facets[f][(i + 1) % 3], s.facets[f][(i + 2) % 3]};
      if (side[1] < side[0]) std::swap(side[0], side[1]);
      EXPECT_EQ(table.segments[table.facet_segments[f][i]], side);
    }
  }
}

TEST(SegmentTable, MergesSegmentsWithSidesAndEachOther) {
  Surface s = tetrahedron();
  s.vertices.push_back({5, 5, 5});
  s.segments = {{4, 3}, {1, 0}, {3, 4}, {0, 1}};
  const SegmentTable table = segment_table(s.view());
  EXPECT_EQ(table.segments.size(), 7u);
  EXPECT_EQ(table.input_segment[table.find(0, 1)], 1u);
  EXPECT_EQ(table.input_segment[table.find(4, 3)], 0u);
  EXPECT_TRUE(table.facets_of(table.find(3, 4)).empty());
  EXPECT_EQ(table.find(2, 4), no_index);
}

TEST(SegmentTable, FindsSegmentsFromBothEndsAndNoneElsewhere) {
  Surface s = tetrahedron();
  s.vertices.insert(s.vertices.begin() + 1, {9, 9, 9});  // an isolated vertex 1
  for (Triangle& t : s.facets)
    for (Index& v : t) v += v > 0 ? 1 : 0;
  const SegmentTable table = segment_table(s.view());
  EXPECT_EQ(table.first_of_vertex, (std::vector<Index>{0, 3, 3, 5, 6, 6}));
  for (Index i = 0; i < table.segments.size(); ++i) {
    EXPECT_EQ(table.find(table.segments[i][0], table.segments[i][1]), i);
    EXPECT_EQ(table.find(table.segments[i][1], table.segments[i][0]), i);
  }
  for (Index v = 0; v < 9; ++v) EXPECT_EQ(table.find(1, v), no_index);
  EXPECT_EQ(table.find(7, 8), no_index);
  EXPECT_EQ(table.find(no_index, no_index), no_index);
}

TEST(SegmentTable, EmptyComplex) {
  const SegmentTable table = segment_table(Complex{});
  EXPECT_TRUE(table.segments.empty());
  EXPECT_EQ(table.first_facet.size(), 1u);
  const SurfaceTopology topology = surface_topology(Complex{}, table);
  EXPECT_EQ(topology.components, 0u);
  EXPECT_FALSE(topology.closed);
}

TEST(SurfaceTopology, ClosedSurface) {
  const SurfaceTopology topology = topology_of(tetrahedron());
  EXPECT_TRUE(topology.closed);
  EXPECT_EQ(topology.components, 1u);
  EXPECT_EQ(topology.border_segments + topology.nonmanifold_segments + topology.odd_segments, 0u);
  EXPECT_EQ(topology.dangling_facets, 0u);
}

TEST(SurfaceTopology, FinPeelsOffAndLeavesTheRest) {
  Surface s = tetrahedron();
  s.vertices.insert(s.vertices.end(), {{1, -1, 0}, {2, -1, 0}});
  s.facets.insert(s.facets.end(), {{0, 1, 4}, {1, 4, 5}});
  const SurfaceTopology topology = topology_of(s);
  EXPECT_FALSE(topology.closed);
  EXPECT_EQ(topology.nonmanifold_segments, 1u);
  EXPECT_EQ(topology.border_segments, 3u);
  EXPECT_EQ(topology.odd_segments, 4u);
  EXPECT_EQ(topology.dangling_facets, 2u);
}

TEST(SurfaceTopology, DiaphragmDoesNotPeel) {
  // Two tetrahedra on both sides of facet (0, 1, 2), which both share.
  Surface s = tetrahedron();
  s.vertices.push_back({0, 0, -1});
  s.facets.insert(s.facets.end(), {{0, 1, 4}, {1, 2, 4}, {2, 0, 4}});
  const SurfaceTopology topology = topology_of(s);
  EXPECT_TRUE(topology.closed);
  EXPECT_EQ(topology.nonmanifold_segments, 3u);
  EXPECT_EQ(topology.odd_segments, 3u);
  EXPECT_EQ(topology.dangling_facets, 0u);
}

TEST(SurfaceTopology, CountsComponentsAndIsolatedVertices) {
  Surface s = tetrahedron();
  s.vertices.insert(s.vertices.end(), {{5, 0, 0}, {6, 0, 0}, {7, 0, 0}});
  s.segments = {{4, 5}};
  const SurfaceTopology topology = topology_of(s);
  EXPECT_EQ(topology.components, 3u);
  EXPECT_EQ(topology.isolated_vertices, 1u);
  EXPECT_EQ(topology.dangling_segments, 1u);
}

TEST(SurfaceTopology, OpenDiscIsAllDangling) {
  Surface s = tetrahedron();
  s.facets.pop_back();
  EXPECT_EQ(topology_of(s).dangling_facets, 3u);
}

}  // namespace
}  // namespace holdfast::surface_complex_test
