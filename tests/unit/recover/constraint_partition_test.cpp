// Partition: chains on segments and sub-facets in facets, covered exactly.
#include <gtest/gtest.h>

#include "enforce/facet_section.h"
#include "enforce/partition_facet.h"
#include "enforce/partition_segment.h"
#include "mesh/validate.h"
#include "mesh_fixtures.h"
#include "unit/enforced.h"

namespace holdfast::constraint_partition_test {
namespace {

using namespace testing;

// --- partition

TEST(PartitionSegment, MakesAChainThroughFacesAndEdges) {
  Surface surface;
  surface.vertices = points_and_grid(1);
  const Task start = task(surface);
  Random random(1);
  std::size_t through_faces = 0, through_edges = 0, missing = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const auto a = static_cast<Vertex>(random() % 67),
               b = static_cast<Vertex>(trial % 2 * 40 + random() % 27);
    if (a == b || vertices_on(start.mesh, a, b).size() != 2) continue;
    Task t = start;
    t.surface.segments = {{a, b}};
    t.table = segment_table(t.surface.view());
    missing += find_edge(t.mesh, a, b) == kNone ? 1 : 0;
    const std::size_t tets = t.mesh.tet_count();
    const std::vector<Vertex> chain = partition_segment(t.mesh, a, b, t.first_free);
    EXPECT_EQ(chain, vertices_on(t.mesh, a, b));
    EXPECT_EQ(chain.size(), t.mesh.vertex_count() - start.mesh.vertex_count() + 2);
    expect_laid(t);
    // Every face adds 4 tetrahedra, every edge as many as are around it, at least 3.
    if (t.mesh.tet_count() == tets + 4 * (chain.size() - 2)) ++through_faces;
    if (t.mesh.tet_count() > tets + 4 * (chain.size() - 2)) ++through_edges;
  }
  EXPECT_GT(missing, 50u);
  EXPECT_GT(through_faces, 20u);
  EXPECT_GT(through_edges, 5u);
}

TEST(PartitionSegment, TakesUpSteinerPointsAndRefusesInputVertices) {
  Surface surface;
  surface.vertices = random_points(40, 2);
  surface.vertices.insert(surface.vertices.end(), {{-1, -1, -1}, {1, 1, 1}});
  surface.segments = {{40, 41}};
  Task t = task(surface, {{0.25, 0.25, 0.25}, {-0.5, -0.5, -0.5}});
  const std::vector<Vertex> chain = partition_segment(t.mesh, 40, 41, t.first_free);
  for (Vertex v = t.first_free; v < t.first_free + 2; ++v)
    EXPECT_EQ(std::count(chain.begin(), chain.end(), v), 1);
  EXPECT_EQ(chain, vertices_on(t.mesh, 40, 41));
  expect_laid(t);
  Task refused = task(surface, {{0.25, 0.25, 0.25}});
  EXPECT_THROW(partition_segment(refused.mesh, 40, 41, refused.first_free + 1), std::logic_error);
  EXPECT_EQ(find_fault(refused.mesh), "");
}

// The vertices strictly inside the facet, whose sides are chains.
std::vector<Vertex> inside(const Task& t, const FacetFrame& frame) {
  std::vector<Vertex> out;
  for (Vertex v = t.first_free; v < t.mesh.vertex_count(); ++v)
    if (Plane(t, frame.corners).holds(t.mesh, v) &&
        std::none_of(frame.sides.begin(), frame.sides.end(),
                     [&](const auto& side) { return std::count(side.begin(), side.end(), v) > 0; }))
      out.push_back(v);
  return out;
}

// The edges through the inside of the facet, from above to below.
std::set<EdgeEnds> piercing(const Task& t, const FacetFrame& frame) {
  const auto [a, b, c] = frame.corners;
  std::set<EdgeEnds> out;
  for (const Tet tet : living(t.mesh))
    for (const Vertex u : t.mesh.corners(tet))
      for (const Vertex v : t.mesh.corners(tet))
        if (!t.mesh.is_ghost(tet) && t.mesh.orient(a, b, c, u) > 0 && t.mesh.orient(a, b, c, v) < 0 &&
            t.mesh.orient(a, b, v, u) > 0 && t.mesh.orient(b, c, v, u) > 0 && t.mesh.orient(c, a, v, u) > 0)
          out.insert({u, v});
  return out;
}

TEST(PartitionFacet, CoversTheFacetAndFindsAllThatIsInside) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Task t = facet_task(seed, seed % 2 == 0);
    FacetFrame frame{{0, 1, 2}, {}};
    for (Vertex i = 0; i < 3; ++i)
      frame.sides[i] = partition_segment(t.mesh, (i + 1) % 3, (i + 2) % 3, t.first_free);
    const FacetSection section = facet_section(t.mesh, frame);
    EXPECT_EQ(section.inner, inside(t, frame));
    std::set<EdgeEnds> found;
    for (const auto& e : section.piercing) found.insert({e.above, e.below});
    EXPECT_EQ(found, piercing(t, frame));
    EXPECT_GT(found.size(), 0u);
    EXPECT_EQ(found.size(), section.piercing.size());
    const FacetPieces pieces = partition_facet(t.mesh, frame);
    EXPECT_EQ(pieces.added, found.size());
    EXPECT_EQ(pieces.inner, inside(t, frame));
    EXPECT_EQ(pieces.faces.size(), facet_section(t.mesh, frame).faces.size());
    expect_laid(t);
    EXPECT_TRUE(facet_section(t.mesh, frame).stands());
  }
}

}  // namespace
}  // namespace holdfast::constraint_partition_test
