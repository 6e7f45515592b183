// MeshEditor: its own operations, and when the validator runs. Cavities: mesh_replace_test.cpp.
#include <gtest/gtest.h>

#include <stdexcept>

#include "mesh/assembly.h"
#include "mesh/validate.h"
#include "mesh_fixtures.h"

namespace holdfast::mesh_editor_test {
namespace {

using testing::delaunay_in_box;
using testing::living;
using testing::random_points;

// Whether code that holds a mesh may change it without the editor.
template <typename Mesh>
concept Writable = requires(Mesh& m) {
  m.add_vertex(Point{});
}
|| requires(Mesh& m) { m.move_vertex(0, Point{}); }
|| requires(Mesh& m) { m.remove_vertex(0); }
|| requires(Mesh& m) { m.remove_tet(0); }
|| requires(Mesh& m) { m.put_tet(0, {}, {}, 0); }
|| requires(Mesh& m) { m.set_neighbour(0, 0); }
|| requires(Mesh& m) { m.set_flags(0, 0); }
|| requires(Mesh& m) { m.set_incident(0, 0); }
|| requires(Mesh& m) { m.set_tets({}); }
|| requires(Mesh& m) { m.renumber({}, 0, {}); };
static_assert(!Writable<TetMesh>);

constexpr Vertex kMoved = 7;  // one of the points, inside the box

// Runs an operation that breaks an invariant: builds with HOLDFAST_VALIDATE throw, and in others the
// validator finds the fault afterwards.
template <typename Operation>
void expect_caught(TetMesh& mesh, Operation operation) {
#ifdef HOLDFAST_VALIDATE
  EXPECT_THROW(operation(), std::logic_error);
#else
  operation();
#endif
  EXPECT_NE(find_fault(mesh), "");
}

TEST(MeshEditor, MovesAVertexInsideItsKernel) {
  TetMesh mesh = delaunay_in_box(random_points(40, 1));
  std::vector<Tet> tets;
  ball(mesh, kMoved, tets);
  const auto place = kernel_of_ball(mesh, kMoved, tets).find(mesh.point(kMoved));
  ASSERT_TRUE(place.has_value());
  MeshEditor(mesh).move_vertex(kMoved, *place);
  EXPECT_EQ(find_fault(mesh), "");
  EXPECT_EQ(mesh.position(kMoved), std::get<Point>(*place));
}

TEST(MeshEditor, AMoveOutOfTheKernelIsCaught) {
  TetMesh mesh = delaunay_in_box(random_points(40, 1));
  expect_caught(mesh, [&] { MeshEditor(mesh).move_vertex(kMoved, Point{100, 0, 0}); });
}

TEST(MeshEditor, AVertexOutsideTheMeshMovesAnywhere) {
  TetMesh mesh = delaunay_in_box(random_points(40, 1));
  const Vertex v = MeshEditor(mesh).add_vertex(Point{0, 0, 0});
  MeshEditor(mesh).move_vertex(v, Point{100, 0, 0});
  EXPECT_EQ(mesh.position(v), (Point{100, 0, 0}));
  EXPECT_EQ(find_fault(mesh), "");
}

TEST(MeshEditor, MarksAFacetOnBothSides) {
  TetMesh mesh = delaunay_in_box(random_points(40, 2));
  const Face f = face_code(mesh.incident(0), 2);
  MeshEditor(mesh).set_facet(f);
  EXPECT_TRUE(mesh.is_facet(f));
  EXPECT_TRUE(mesh.is_facet(mesh.neighbour(f)));
  EXPECT_EQ(find_fault(mesh), "");
}

TEST(MeshEditor, LoadsAndRenumbersAWholeMesh) {
  const TetMesh from = delaunay_in_box(random_points(40, 3));
  TetMesh mesh;
  for (const Point& p : from.positions()) MeshEditor(mesh).add_vertex(p);
  std::vector<TetMesh::Cell> cells;
  for (Tet t = 0; t < from.slot_count(); ++t) {
    ASSERT_TRUE(from.alive(t));
    cells.push_back({from.corners(t), from.neighbours(t)});
  }
  MeshEditor editor(mesh);
  editor.load(cells);
  EXPECT_EQ(find_fault(mesh), "");

  const std::vector<Tet> all = living(mesh);
  editor.renumber(std::vector<Tet>(all.rbegin(), all.rend()), static_cast<Vertex>(mesh.vertex_count()), {});
  EXPECT_EQ(find_fault(mesh), "");
  EXPECT_EQ(mesh.corners(0), from.corners(all.back()));
}

TEST(MeshEditor, ALostNeighbourIsCaught) {
  TetMesh mesh = delaunay_in_box(random_points(40, 4));
  expect_caught(mesh, [&] {
    MeshAssembly editor(mesh);
    const Tet t = mesh.incident(0);
    editor.link(face_code(t, 0), mesh.neighbour(t, 1));
    editor.finish(std::array{t});
  });
}

}  // namespace
}  // namespace holdfast::mesh_editor_test
