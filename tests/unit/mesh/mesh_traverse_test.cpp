// Balls, shells, look-ups, edge removal and the validator, against exhaustive search and planted faults.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <stdexcept>

#include "mesh/assembly.h"
#include "mesh/edge_removal.h"
#include "mesh/traverse.h"
#include "mesh/validate.h"
#include "mesh_fixtures.h"

namespace holdfast::mesh_traverse_test {
namespace {

using namespace testing;
using Random = std::mt19937_64;

// Random points and a grid, whose Delaunay mesh has edges and faces of many kinds.
TetMesh sample_mesh(std::uint64_t seed) {
  std::vector<Point> points = random_points(50, seed);
  for (int k = 0; k < 27; ++k)
    points.push_back({0.5 * (k % 3 - 1), 0.5 * (k / 3 % 3 - 1), 0.5 * (k / 9 - 1)});
  return delaunay_in_box(points);
}

TEST(Traverse, BallIsEveryTetrahedronAtTheVertex) {
  TetMesh mesh = sample_mesh(1);
  const TetMesh before = mesh;
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    std::vector<Tet> tets = ball_of(mesh, v);
    std::sort(tets.begin(), tets.end());
    EXPECT_EQ(tets, living_with(mesh, {v})) << v;
  }
  EXPECT_EQ(difference(mesh, before), "");  // scratch bits are clear again
}

TEST(Traverse, BallIsAppendedAndEmptyOutsideTheMesh) {
  TetMesh mesh = sample_mesh(2);
  std::vector<Tet> tets{7, 7};
  ball(mesh, 3, tets);
  EXPECT_EQ(tets.size(), 2 + living_with(mesh, {3}).size());
  EXPECT_EQ(tets[0], 7u);
  const Vertex v = MeshEditor(mesh).add_vertex(Point{0, 0, 0.1});
  EXPECT_TRUE(ball_of(mesh, v).empty());
  EXPECT_EQ(find_edge(mesh, v, 0), kNone);
}

TEST(Traverse, EdgesAndTheirShells) {
  TetMesh mesh = sample_mesh(3);
  int edges = 0;
  for (Vertex a = 0; a < mesh.vertex_count(); ++a)
    for (Vertex b = 0; b < mesh.vertex_count(); ++b) {
      if (a == b) continue;
      const std::vector<Tet> expected = living_with(mesh, {a, b});
      const Tet t = find_edge(mesh, a, b);
      ASSERT_EQ(t == kNone, expected.empty()) << a << " " << b;
      if (t == kNone) continue;
      ++edges;
      const std::vector<Tet> found = shell_of(mesh, a, b);
      EXPECT_EQ(found[0], t);
      for (std::size_t k = 0; k < found.size(); ++k) {  // consecutive around the edge, in one direction
        const Tet s = found[k], next = found[(k + 1) % found.size()];
        const auto& cd = kOpposite[static_cast<std::size_t>(mesh.index_of(s, a))]
                                  [static_cast<std::size_t>(mesh.index_of(s, b))];
        EXPECT_EQ(tet_of(mesh.neighbour(s, cd[0])), next);
      }
      EXPECT_EQ(sorted(found), expected);
    }
  EXPECT_GT(edges, 500);
}

TEST(TetMesh, BothOrientationsAreThoseOfEach) {
  TetMesh mesh = delaunay_in_box(random_points(30, 4));
  const auto expect_equal = [&] {
    for (Vertex a = 0; a + 5 <= mesh.vertex_count(); ++a) {
      const auto [of_d, of_e] = mesh.orient_both(a, a + 1, a + 2, a + 3, a + 4);
      EXPECT_EQ(of_d, mesh.orient(a, a + 1, a + 2, a + 3));
      EXPECT_EQ(of_e, mesh.orient(a, a + 1, a + 2, a + 4));
    }
    EXPECT_EQ(mesh.orient_both(0, 1, 2, 1, 3)[0], 0);
  };
  expect_equal();
  const exact::Dyadic near_one = exact::Dyadic(1) + exact::Dyadic(1).scaled(-60);
  MeshEditor(mesh).add_vertex(exact::ExactPoint{{near_one, near_one, near_one}});
  ASSERT_EQ(mesh.exact_vertex_count(), 1u);
  expect_equal();
}

TEST(Traverse, Faces) {
  TetMesh mesh = sample_mesh(4);
  Random random(4);
  int found = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    // Three random corners of one tetrahedron, or two of them and any other vertex.
    const auto t = static_cast<Tet>(random() % mesh.slot_count());
    TetMesh::Corners c = mesh.corners(t);
    std::shuffle(c.begin(), c.end(), random);
    if (trial % 2 == 0) c[2] = static_cast<Vertex>(random() % mesh.vertex_count());
    if (c[0] == kGhost || c[1] == kGhost || c[2] == kGhost || c[2] == c[0] || c[2] == c[1]) continue;
    const bool expected = !living_with(mesh, {c[0], c[1], c[2]}).empty();
    const Face f = find_face(mesh, c[0], c[1], c[2]);
    ASSERT_EQ(f != kNone, expected);
    if (f == kNone) continue;
    ++found;
    EXPECT_EQ(sorted(mesh.face_vertices(f)), sorted(FaceKey{c[0], c[1], c[2]}));
  }
  EXPECT_GT(found, 500);
}

TEST(Traverse, SegmentBitsGoRoundTheShell) {
  TetMesh mesh = sample_mesh(5);
  Random random(5);
  std::set<EdgeEnds> expected;
  for (int k = 0; k < 40; ++k) {
    const auto t = static_cast<Tet>(random() % mesh.slot_count());
    const auto& e = kEdgeVertex[random() % 6];
    const Vertex a = mesh.corner(t, e[0]), b = mesh.corner(t, e[1]);
    if (a == kGhost || b == kGhost) continue;
    MeshEditor(mesh).set_segment(t, a, b);
    expected.insert(sorted(EdgeEnds{a, b}));
  }
  EXPECT_EQ(segment_edges(mesh), expected);
  EXPECT_EQ(find_fault(mesh), "");
}

// Random costs of triangles and diagonals, some of them forbidden: the result has the stated cost, and no
// triangulation costs less.
struct RandomCosts {
  using Cost = int;
  std::array<std::array<std::array<int, 9>, 9>, 9> triangles{};
  std::array<std::array<int, 9>, 9> diagonals{};

  explicit RandomCosts(Random& random) {
    for (auto& plane : triangles)
      for (auto& row : plane)
        for (int& x : row) x = random() % 4 == 0 ? -1 : static_cast<int>(random() % 50);
    for (auto& row : diagonals)
      for (int& x : row) x = static_cast<int>(random() % 50);
  }
  [[nodiscard]] Cost none() const { return 0; }
  [[nodiscard]] Cost join(Cost x, Cost y) const { return x + y; }
  [[nodiscard]] bool better(Cost x, Cost y) const { return x < y; }
  [[nodiscard]] std::optional<Cost> triangle(std::size_t i, std::size_t k, std::size_t j) const {
    return triangles[i][k][j] < 0 ? std::nullopt : std::optional(triangles[i][k][j]);
  }
  [[nodiscard]] Cost diagonal(std::size_t i, std::size_t j) const { return diagonals[i][j]; }
};

// The least cost of the polygon i .. j by trying every triangulation.
std::optional<int> least_cost(const RandomCosts& costs, std::size_t n, std::size_t i, std::size_t j) {
  if (j == i + 1) return 0;
  std::optional<int> least;
  for (std::size_t k = i + 1; k < j; ++k) {
    const auto triangle = costs.triangle(i, k, j), left = least_cost(costs, n, i, k),
               right = least_cost(costs, n, k, j);
    if (!triangle || !left || !right) continue;
    const int cost = *triangle + *left + *right + (i == 0 && j + 1 == n ? 0 : costs.diagonal(i, j));
    if (!least || cost < *least) least = cost;
  }
  return least;
}

TEST(LinkTriangulation, AgreesWithAnExhaustiveSearch) {
  Random random(6);
  LinkTriangulation<int> triangulation;
  int impossible = 0;
  for (int trial = 0; trial < 400; ++trial) {
    RandomCosts costs(random);
    const std::size_t n = 3 + random() % 6;
    const auto expected = least_cost(costs, n, 0, n - 1);
    ASSERT_EQ(triangulation.find(n, costs), expected) << "n " << n;
    if (!expected) {
      ++impossible;
      continue;
    }
    std::vector<LinkTriangle> triangles;
    triangulation.triangles(n, triangles);
    ASSERT_EQ(triangles.size(), n - 2);
    std::map<std::pair<int, int>, int> sides;
    int cost = 0;
    for (const auto& [i, k, j] : triangles) {
      cost += *costs.triangle(i, k, j);
      for (const auto& [p, q] : {std::pair{i, k}, std::pair{k, j}, std::pair{i, j}}) ++sides[{p, q}];
    }
    for (const auto& [side, count] : sides) {
      const auto [p, q] = side;
      const bool of_polygon = q == p + 1 || (p == 0 && static_cast<std::size_t>(q) == n - 1);
      EXPECT_EQ(count, of_polygon ? 1 : 2);
      if (!of_polygon) cost += costs.diagonal(static_cast<std::size_t>(p), static_cast<std::size_t>(q));
    }
    EXPECT_EQ(cost, *expected);
  }
  EXPECT_GT(impossible, 20);
}

// Any triangulation visible from both ends of an edge.
struct Visible {
  using Cost = int;
  const TetMesh& mesh;
  const EdgeShell& shell;
  [[nodiscard]] Cost none() const { return 0; }
  [[nodiscard]] Cost join(Cost x, Cost y) const { return x + y; }
  [[nodiscard]] bool better(Cost x, Cost y) const { return x < y; }
  [[nodiscard]] std::optional<Cost> triangle(std::size_t i, std::size_t k, std::size_t j) const {
    return sees_both_ends(mesh, shell, i, k, j) ? std::optional(1) : std::nullopt;
  }
  [[nodiscard]] Cost diagonal(std::size_t, std::size_t) const { return 0; }
};

TEST(EdgeRemoval, RemovesEdgesFromTheMesh) {
  TetMesh mesh = sample_mesh(7);
  const exact::Dyadic volume = volume_of(mesh);
  Random random(7);
  int removed = 0, at_hull = 0;
  LinkTriangulation<int> triangulation;
  for (int trial = 0; trial < 3000; ++trial) {
    const auto t = static_cast<Tet>(random() % mesh.slot_count());
    if (!mesh.alive(t) || mesh.is_ghost(t)) continue;
    const auto& e = kEdgeVertex[random() % 6];
    const Vertex a = mesh.corner(t, e[0]), b = mesh.corner(t, e[1]);
    EdgeShell shell;
    const auto all = living_with(mesh, {a, b});
    const bool inside = std::none_of(all.begin(), all.end(), [&](Tet s) { return mesh.is_ghost(s); });
    ASSERT_EQ(gather_shell(mesh, t, a, b, shell), inside && all.size() <= kMostLink);
    if (!inside) {
      ++at_hull;
      continue;
    }
    Visible objective{mesh, shell};
    if (shell.size() > kMostLink || !triangulation.find(shell.size(), objective)) continue;
    std::vector<LinkTriangle> triangles;
    triangulation.triangles(shell.size(), triangles);
    std::vector<TetMesh::Corners> fresh;
    tetrahedra_of(shell, triangles, fresh);
    ASSERT_EQ(fresh.size(), 2 * shell.size() - 4);
    ASSERT_TRUE(all_positive(mesh, fresh));
    std::vector<Tet> created;
    MeshEditor(mesh).replace_shell(shell, triangles, &created);
    EXPECT_EQ(find_edge(mesh, a, b), kNone);
    for (std::size_t k = 0; k < fresh.size(); ++k) EXPECT_EQ(mesh.corners(created[k]), fresh[k]);
    ++removed;
  }
  EXPECT_EQ(find_fault(mesh), "");
  EXPECT_EQ(volume_of(mesh), volume);
  EXPECT_GT(removed, 100);
  EXPECT_GT(at_hull, 10);
}

// A fault put into a sound mesh, and a word of the validator's answer.
struct PlantedFault {
  const char* says;
  std::function<void(TetMesh&, Tet)> plant;  // at a tetrahedron whose neighbours are finite
};

const PlantedFault kFaults[] = {
    {"neighbour",
     [](TetMesh& m, Tet t) {  // two faces of t at once claim the same neighbour
       MeshAssembly(m).link(face_code(t, 0), m.neighbour(t, 1));
     }},
    {"shares no face",
     [](TetMesh& m, Tet t) {
       const Face f = m.neighbour(t, 0), g = m.neighbour(t, 1);
       MeshAssembly(m).link(face_code(t, 0), g);
       MeshAssembly(m).link(face_code(t, 1), f);
     }},
    {"not positive",
     [](TetMesh& m, Tet t) {  // one corner goes through the opposite face
       const Vertex v = m.corner(t, 0);
       Point p{};
       for (std::size_t k = 0; k < 3; ++k) p[k] = 2 * m.position(m.corner(t, 1))[k] - m.position(v)[k];
       MeshAssembly(m).place_vertex(v, p);
     }},
    {"not positive",
     [](TetMesh& m, Tet t) {  // flat: one corner on another's place
       MeshAssembly(m).place_vertex(m.corner(t, 0), m.position(m.corner(t, 1)));
     }},
    {"facet bit on one side", [](TetMesh& m, Tet t) { MeshAssembly(m).set_flags(t, facet_bit(2)); }},
    {"facet bit on one side",
     [](TetMesh& m, Tet t) {
       MeshEditor(m).set_facet(face_code(t, 1));
       MeshAssembly(m).clear_flags(tet_of(m.neighbour(t, 1)), kFacetBits);
     }},
    {"shell lacks", [](TetMesh& m, Tet t) { MeshAssembly(m).set_flags(t, segment_bit(4)); }},
    {"shell lacks",
     [](TetMesh& m, Tet t) {
       MeshEditor(m).set_segment(t, m.corner(t, 0), m.corner(t, 1));
       MeshAssembly(m).clear_flags(t, kSegmentBits);
     }},
    {"left visited", [](TetMesh& m, Tet t) { m.mark_visited(t); }},
    {"lacks a neighbour",
     [](TetMesh& m, Tet t) {
       const Tet lost = tet_of(m.neighbour(t, 3));
       for (const Tet s : living(m))
         if (s != lost)
           for (const Vertex v : m.corners(s))
             if (v != kGhost) MeshAssembly(m).set_incident(v, s);
       MeshAssembly(m).remove_tet(lost);
     }},
    {"without an incident", [](TetMesh& m, Tet t) { MeshAssembly(m).set_incident(m.corner(t, 3), kNone); }},
    {"without an incident",
     [](TetMesh& m, Tet t) {
       const Vertex v = m.corner(t, 3);
       for (const Tet s : living(m))
         if (m.index_of(s, v) < 0) MeshAssembly(m).set_incident(v, s);
     }},
    {"names a vertex twice",
     [](TetMesh& m, Tet t) {
       MeshAssembly(m).add_tet({m.corner(t, 0), m.corner(t, 1), m.corner(t, 2), m.corner(t, 1)});
     }},
    {"names no vertex",
     [](TetMesh& m, Tet t) {
       MeshAssembly(m).add_tet(
           {m.corner(t, 0), static_cast<Vertex>(m.vertex_count()), m.corner(t, 2), m.corner(t, 3)});
     }},
    {"names no vertex",
     [](TetMesh& m, Tet t) {
       MeshAssembly(m).add_tet(
           {m.corner(t, 0), m.corner(t, 1), m.corner(t, 2), static_cast<Vertex>(m.vertex_count())});
     }},
    {"names no vertex",
     [](TetMesh& m, Tet t) {
       MeshAssembly(m).add_tet({m.corner(t, 0), kGhost, m.corner(t, 2), m.corner(t, 3)});
     }},
    {"lacks a neighbour", [](TetMesh& m, Tet t) { MeshAssembly(m).add_tet(m.corners(t)); }},
};

TEST(Validate, FindsPlantedFaults) {
  const TetMesh sound = sample_mesh(8);
  ASSERT_EQ(find_fault(sound), "");
  int planted = 0;
  for (const Tet t : living(sound)) {
    bool inner = !sound.is_ghost(t);
    for (int i = 0; i < 4 && inner; ++i) inner = !sound.is_ghost(tet_of(sound.neighbour(t, i)));
    if (!inner || t % 7 != 0) continue;
    for (const PlantedFault& fault : kFaults) {
      TetMesh mesh = sound;
      fault.plant(mesh, t);
      const std::string found = find_fault(mesh);
      EXPECT_NE(found.find(fault.says), std::string::npos) << fault.says << ", found: " << found;
      ++planted;
    }
  }
  EXPECT_GT(planted, 100);
}

TEST(Validate, ThrowsForTheTetrahedraNamed) {
  TetMesh mesh = sample_mesh(9);
  const std::vector<Tet> all = living(mesh);
  throw_on_fault(mesh, all);
  mesh.mark_visited(all[5]);
  throw_on_fault(mesh, std::span(all).first(5));
  EXPECT_THROW(throw_on_fault(mesh, all), std::logic_error);
  mesh.clear_visited(all[5]);
  MeshAssembly(mesh).remove_tet(all[9]);
  EXPECT_NE(find_fault(mesh, all[9]), "");
}

}  // namespace
}  // namespace holdfast::mesh_traverse_test
