// Failed trials at a vertex or an edge, which count until something there changes.
#include "optimise/in_vain.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "delaunay/delaunay.h"
#include "mesh/editor.h"

namespace holdfast::in_vain_test {
namespace {

// A point in a tetrahedron: four tetrahedra, three around each edge at the point.
struct OneInside {
  TetMesh mesh;
  EdgeShell shell;  // of the edge from the first corner to the point

  OneInside() {
    for (const Point& p :
         {Point{1, 1, 1}, Point{1, -1, -1}, Point{-1, 1, -1}, Point{-1, -1, 1}, Point{0, 0, 0}})
      MeshEditor(mesh).add_vertex(p);
    EXPECT_TRUE(build_delaunay(mesh, {1}, nullptr));
    for (Tet t = 0; t < mesh.slot_count() && shell.tets.empty(); ++t)
      if (mesh.alive(t) && !mesh.is_ghost(t) && has(t, 0) && has(t, 4)) {
        EXPECT_TRUE(gather_shell(mesh, t, 0, 4, shell));
      }
  }
  [[nodiscard]] bool has(Tet t, Vertex v) const {
    const TetMesh::Corners& c = mesh.corners(t);
    return std::find(c.begin(), c.end(), v) != c.end();
  }
  [[nodiscard]] InVain in_vain() const {
    InVain all;
    all.make_room(mesh.slot_count(), mesh.vertex_count());
    return all;
  }
};

TEST(InVain, AVertexHasEachWayOfItsOwn) {
  const OneInside one;
  InVain in_vain = one.in_vain();
  in_vain.add(4, InVain::AtVertex::smoothing);
  EXPECT_TRUE(in_vain.has(4, InVain::AtVertex::smoothing));
  EXPECT_FALSE(in_vain.has(4, InVain::AtVertex::contraction));
  EXPECT_FALSE(in_vain.has(0, InVain::AtVertex::smoothing));
}

TEST(InVain, AVertexIsForgottenWithATetrahedronOfItsBall) {
  const OneInside one;
  InVain in_vain = one.in_vain();
  in_vain.add(4, InVain::AtVertex::smoothing);
  in_vain.forget(one.shell.tets[0], one.mesh.corners(one.shell.tets[0]));
  EXPECT_FALSE(in_vain.has(4, InVain::AtVertex::smoothing));
}

TEST(InVain, AnEdgeIsForgottenWithOneTetrahedronOfItsShell) {
  const OneInside one;
  ASSERT_EQ(one.shell.tets.size(), 3U);
  InVain in_vain = one.in_vain();
  in_vain.add(one.mesh, one.shell, InVain::AtEdge::point);
  EXPECT_TRUE(in_vain.has(one.mesh, one.shell, InVain::AtEdge::point));
  EXPECT_FALSE(in_vain.has(one.mesh, one.shell, InVain::AtEdge::point_with_patience));
  in_vain.forget(one.shell.tets[1], one.mesh.corners(one.shell.tets[1]));
  EXPECT_FALSE(in_vain.has(one.mesh, one.shell, InVain::AtEdge::point));
}

}  // namespace
}  // namespace holdfast::in_vain_test
