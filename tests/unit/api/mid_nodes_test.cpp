// Mid-edge nodes: one per edge, in its middle, the same for all elements that share it.
#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

#include "holdfast/holdfast.h"
#include "holdfast/second_order.h"
#include "second_order/edges_of.h"
#include "small_surfaces.h"

namespace holdfast::mid_nodes_test {
namespace {

using Edge = std::array<Index, 2>;

Edge sorted(Index a, Index b) { return a < b ? Edge{a, b} : Edge{b, a}; }

Volume meshed_box() {
  Options options;
  options.sizes = Sizes{.size = 0.4};
  Surface box = small::box();
  box.segments = {{0, 1}};
  Result result = mesh(box, options);
  EXPECT_EQ(result.outcome, Outcome::done);
  return result.volume;
}

template <typename Entities, typename Nodes, typename Edges>
void expect_nodes(const Volume& volume, const Entities& entities, const Nodes& nodes, const Edges& edges,
                  std::map<Edge, Index>& of_edge) {
  ASSERT_EQ(entities.size(), nodes.size());
  for (std::size_t i = 0; i < entities.size(); ++i)
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const Index a = entities[i][edges[e][0]], b = entities[i][edges[e][1]], node = nodes[i][e];
      EXPECT_EQ(of_edge.try_emplace(sorted(a, b), node).first->second, node);
      ASSERT_GE(node, volume.vertices.size());
      ASSERT_LT(node - volume.vertices.size(), volume.mid_nodes.points.size());
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(volume.mid_nodes.points[node - volume.vertices.size()][k],
                  0.5 * volume.vertices[a][k] + 0.5 * volume.vertices[b][k]);
    }
}

TEST(MidNodes, EveryEdgeHasOneInItsMiddle) {
  Volume volume = meshed_box();
  ASSERT_GT(volume.tetrahedra.size(), 12u);
  add_mid_nodes(volume);
  std::map<Edge, Index> of_edge;
  expect_nodes(volume, volume.tetrahedra, volume.mid_nodes.tetrahedra, kTetrahedronEdges, of_edge);
  EXPECT_EQ(of_edge.size(), volume.mid_nodes.points.size());
  expect_nodes(volume, volume.facets, volume.mid_nodes.facets, kFacetEdges, of_edge);
  EXPECT_EQ(of_edge.size(), volume.mid_nodes.points.size()) << "edges of facets are edges of tetrahedra";
  ASSERT_EQ(volume.mid_nodes.segments.size(), 1u);
  EXPECT_EQ(volume.mid_nodes.segments[0], of_edge.at({0, 1}));
}

TEST(MidNodes, ReplacesThoseThatAreThere) {
  Volume volume = meshed_box();
  add_mid_nodes(volume);
  const MidNodes before = volume.mid_nodes;
  add_mid_nodes(volume);
  EXPECT_EQ(volume.mid_nodes.points, before.points);
  EXPECT_EQ(volume.mid_nodes.tetrahedra, before.tetrahedra);
}

TEST(MidNodes, OfNothingAreNone) {
  Volume volume;
  add_mid_nodes(volume);
  EXPECT_TRUE(volume.mid_nodes.empty());
}

TEST(MidNodes, RefusesIndicesOfNoVertex) {
  Volume volume;
  volume.vertices.resize(3);
  volume.tetrahedra = {{0, 1, 2, 3}};
  EXPECT_THROW(add_mid_nodes(volume), std::out_of_range);
  EXPECT_TRUE(volume.mid_nodes.empty());
}

TEST(MidNodes, DoNotOverflow) {
  Volume volume;
  volume.vertices = {{1.7e308, 1.5e308, 0}, {1.7e308, 1.7e308, -1}, {0, 0, 0}, {0, 0, 1}};
  volume.tetrahedra = {{0, 1, 2, 3}};
  add_mid_nodes(volume);
  EXPECT_EQ(volume.mid_nodes.points[0], (Point{1.7e308, 1.6e308, -0.5}));
}

}  // namespace
}  // namespace holdfast::mid_nodes_test
