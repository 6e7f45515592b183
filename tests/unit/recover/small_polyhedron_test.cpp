// Small polyhedra are filled with tetrahedra exactly if an exhaustive search fills them.
#include <gtest/gtest.h>

#include "hard_surfaces.h"
#include "suppress/refill.h"
#include "unit/suppress_scenes.h"

namespace holdfast::small_polyhedron_test {
namespace {

using namespace testing;

// The ball of the origin among n points of the unit sphere, each moved to a different radius.
Polyhedron star(int n, double least_radius, Random& random) {
  std::normal_distribution<double> normal;
  Polyhedron out;
  while (out.faces.size() != 2 * static_cast<std::size_t>(n) - 4) {  // else a box corner is in the link
    std::vector<Point> points;
    for (int k = 0; k < n; ++k) {
      const Point p{normal(random), normal(random), normal(random)};
      points.push_back(hard::scaled(p, 1 / std::hypot(p[0], p[1], p[2])));
    }
    points.push_back({0, 0, 0});
    TetMesh mesh = delaunay_in_box(points);
    out = {{}, outer_faces(mesh, ball_of(mesh, static_cast<Vertex>(n)))};
    std::uniform_real_distribution<double> radius(least_radius, 1.0);
    for (int k = 0; k < n; ++k)
      MeshEditor(out.mesh).add_vertex(
          hard::scaled(points[static_cast<std::size_t>(k)], least_radius < 1 ? radius(random) : 1));
  }
  return out;
}

void expect_fills(const Polyhedron& p, const std::vector<TetMesh::Corners>& tets) {
  EXPECT_TRUE(all_positive(p.mesh, tets));
  EXPECT_EQ(boundary_of(tets), as_set(p.faces));
  EXPECT_EQ(testing::volume_of(p.mesh, tets), volume_of(p));
}

// Whether any positive tetrahedra fill the polyhedron: tries all, and stops only at the polyhedron's volume.
bool can_be_filled(const Polyhedron& p, std::set<FaceKey> open, double room) {
  if (open.empty()) return true;
  const FaceKey f = *open.begin();
  for (Vertex v = 0; v < p.mesh.vertex_count(); ++v) {
    if (p.mesh.orient(f[0], f[1], f[2], v) <= 0) continue;
    const std::vector<TetMesh::Corners> one{{f[0], f[1], f[2], v}};
    const double left = room - testing::volume_of(p.mesh, one).to_double();
    if (left < -1e-9) continue;
    std::set<FaceKey> rest = open;
    bool simple = true;
    for (const FaceKey& own : boundary_of(one))
      if (rest.erase(own) == 0) simple = rest.insert(rotated({own[0], own[2], own[1]})).second && simple;
    if (simple && can_be_filled(p, rest, left)) return true;
  }
  return false;
}

constexpr PolyhedronOptions kExhaustive{.most_vertices = 31, .most_nodes = 1'000'000};

TEST(SmallPolyhedron, SchoenhardtsIsFilledOnlyIfItIsConvex) {
  for (const double height : {0.1, 1.0, 7.0})
    for (const double part : {1e-9, 1e-3, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99}) {
      const Polyhedron bent_in = twisted_prism(part * kMostTwist, height);
      EXPECT_FALSE(fill_polyhedron(bent_in.mesh, bent_in.faces, kExhaustive)) << part;
      const Polyhedron convex = twisted_prism(-part * kMostTwist, height);
      const auto filling = fill_polyhedron(convex.mesh, convex.faces);
      ASSERT_TRUE(filling.has_value()) << part;
      expect_fills(convex, *filling);
    }
}

TEST(SmallPolyhedron, ConvexOnesAreFilled) {
  Random random(1);
  for (int trial = 0; trial < 40; ++trial) {
    const Polyhedron p = star(6 + trial % 11, 1, random);
    const auto filling = fill_polyhedron(p.mesh, p.faces);
    ASSERT_TRUE(filling.has_value()) << trial;
    expect_fills(p, *filling);
  }
}

TEST(SmallPolyhedron, AgreesWithAnExhaustiveSearch) {
  Random random(2);
  std::uniform_real_distribution<double> u(-1, 1);
  int filled = 0, unfillable = 0;
  for (int trial = 0; trial < 600; ++trial) {
    Polyhedron p =
        trial % 3 == 0 ? star(6 + trial / 3 % 3, 0.1, random) : twisted_prism(0.2 + 0.2 * u(random), 1);
    for (Vertex v = 0; v < p.mesh.vertex_count(); ++v) {
      Point at = p.mesh.position(v);
      for (double& x : at) x += 0.05 * u(random);
      MeshAssembly(p.mesh).place_vertex(v, at);
    }
    const auto filling = fill_polyhedron(p.mesh, p.faces, kExhaustive);
    ASSERT_EQ(filling.has_value(), can_be_filled(p, as_set(p.faces), volume_of(p).to_double())) << trial;
    if (filling) expect_fills(p, *filling);
    ++(filling ? filled : unfillable);
  }
  EXPECT_GT(filled, 100);
  EXPECT_GT(unfillable, 100);
}

// The ball of the origin among the corners of a cube and some midpoints of its edges and faces.
Polyhedron in_a_cube(int middles, Random& random) {
  std::vector<Point> points, others;
  for (int k = 0; k < 27; ++k) {
    const Point p{k % 3 - 1.0, k / 3 % 3 - 1.0, k / 9 - 1.0};
    const double square = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    if (square > 0) (square > 2 ? points : others).push_back(p);
  }
  std::shuffle(others.begin(), others.end(), random);
  points.insert(points.end(), others.begin(), others.begin() + middles);
  const auto origin = static_cast<Vertex>(points.size());
  points.push_back({0, 0, 0});
  TetMesh mesh = delaunay_in_box(points);
  Polyhedron out{{}, outer_faces(mesh, ball_of(mesh, origin))};
  for (Vertex v = 0; v < origin; ++v) MeshEditor(out.mesh).add_vertex(points[v]);
  return out;
}

TEST(SmallPolyhedron, AgreesWithAnExhaustiveSearchIfManyPointsAreCoplanar) {
  Random random(4);
  for (int trial = 0; trial < 40; ++trial) {
    const Polyhedron p = in_a_cube(trial % 4, random);
    const auto filling = fill_polyhedron(p.mesh, p.faces, kExhaustive);
    ASSERT_EQ(filling.has_value(), can_be_filled(p, as_set(p.faces), volume_of(p).to_double())) << trial;
    if (filling) expect_fills(p, *filling);
  }
}

TEST(SmallPolyhedron, KeepsToItsLimits) {
  Random random(3);
  const Polyhedron p = star(12, 1, random);
  EXPECT_TRUE(fill_polyhedron(p.mesh, p.faces, {.most_vertices = 12, .most_nodes = 600}));
  EXPECT_FALSE(fill_polyhedron(p.mesh, p.faces, {.most_vertices = 11, .most_nodes = 600}));
  EXPECT_FALSE(fill_polyhedron(p.mesh, p.faces, {.most_vertices = 12, .most_nodes = 2}));
}

}  // namespace
}  // namespace holdfast::small_polyhedron_test
