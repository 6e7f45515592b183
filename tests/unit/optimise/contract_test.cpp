// Contraction of a vertex: how long edges may become.
#include "optimise/contract.h"

#include <gtest/gtest.h>

#include "delaunay/delaunay.h"
#include "mesh/editor.h"
#include "mesh/validate.h"

namespace holdfast::contract_test {
namespace {

// A regular tetrahedron of edge 2 sqrt(2), and two points close together in it.
struct TwoInside {
  TetMesh mesh;
  std::vector<RegionId> region_of;
  std::vector<double> sizes;
  const std::vector<bool> kept{true};

  explicit TwoInside(double apart) {
    for (const Point& p : {Point{1, 1, 1}, Point{1, -1, -1}, Point{-1, 1, -1}, Point{-1, -1, 1},
                           Point{0, 0, 0}, Point{apart, 0.1 * apart, 0.2 * apart}})
      MeshEditor(mesh).add_vertex(p);
    EXPECT_TRUE(build_delaunay(mesh, {1}, nullptr));
    region_of.assign(mesh.slot_count(), 0);
    sizes.assign(mesh.vertex_count(), 0.1);
  }
  [[nodiscard]] VolumeData data() { return {mesh, region_of, sizes, kept, 4}; }
};

// All edges at the point are far longer than the size, as near a large facet: it may be removed all the same.
TEST(Contraction, EdgesMayBeAsLongAsTheyWere) {
  TwoInside two(0.01);
  ImprovedVolume volume(two.data());
  VertexContractor contractor(volume);
  EXPECT_FALSE(contractor.contract(5, 0.16).empty());
  EXPECT_FALSE(two.mesh.in_mesh(5));
  EXPECT_EQ(find_fault(two.mesh), "");
}

}  // namespace
}  // namespace holdfast::contract_test
