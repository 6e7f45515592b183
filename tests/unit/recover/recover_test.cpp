// Single flips: edge removal, piercing, recovery of single constraints, undoing.
#include "recover/recover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

#include "delaunay/delaunay.h"
#include "mesh/edge_removal.h"
#include "mesh/editor.h"
#include "mesh/traverse.h"
#include "mesh/validate.h"
#include "recover/facet_cavities.h"
#include "recover/far_points.h"
#include "recover/flipper.h"
#include "recover/insert_vertex.h"
#include "recover/pierce.h"
#include "recover/shell_signs.h"
#include "recover/target.h"
#include "recover/tried_edges.h"

namespace holdfast::recover_test {
namespace {

TetMesh delaunay_of(const std::vector<Point>& points) {
  TetMesh mesh;
  for (const Point& p : points) MeshEditor(mesh).add_vertex(p);
  for (int k = 0; k < 8; ++k)
    MeshEditor(mesh).add_vertex(Point{k & 1 ? 10. : -10., k & 2 ? 10. : -10., k & 4 ? 10. : -10.});
  EXPECT_TRUE(build_delaunay(mesh, {}, nullptr));
  return mesh;
}

// A ring of n vertices round the edge 0 1 on the z axis; its shell is the whole Delaunay mesh's middle.
std::vector<Point> spindle(int n, double half_height) {
  std::vector<Point> points{{0.01, 0.02, -half_height}, {0.01, 0.02, half_height}};
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * 3.14159265358979 * (k + 0.1 * (k % 3)) / n;
    points.push_back({std::cos(angle), std::sin(angle), 0.05 * (k % 2)});
  }
  return points;
}

struct Recovered {
  TetMesh mesh;
  Standing standing;
  FlipStats stats;
};

Recovered recover(const std::vector<Point>& points, const std::vector<Triangle>& facets,
                  const std::vector<Segment>& segments) {
  Recovered run{delaunay_of(points), {}, {}};
  const SegmentTable table = segment_table({points, facets, segments, {}, {}});
  run.standing = mark_present(run.mesh, table);
  const Options options;
  Monitor monitor(options);
  run.stats = FlipRecovery(run.mesh, {table, facets, run.standing}, 1).run([&](double part) {
    monitor.poll(Stage::flips, part);
  });
  EXPECT_EQ(find_fault(run.mesh), "");
  return run;
}

// Prefers triangulations without forbidden diagonals and counts the calls.
struct CountDiagonals {
  using Cost = int;
  std::vector<std::array<std::size_t, 2>> forbidden;
  [[nodiscard]] Cost none() const { return 0; }
  [[nodiscard]] Cost join(Cost x, Cost y) const { return x + y; }
  [[nodiscard]] bool better(Cost x, Cost y) const { return x < y; }
  std::optional<Cost> triangle(std::size_t, std::size_t, std::size_t) { return 0; }
  Cost diagonal(std::size_t i, std::size_t j) {
    return std::count(forbidden.begin(), forbidden.end(), std::array{i, j}) > 0 ? 1 : 0;
  }
};

TEST(LinkTriangulation, AvoidsForbiddenDiagonals) {
  // Of a hexagon's diagonals all but those at corner 4.
  CountDiagonals objective{{{0, 2}, {0, 3}, {1, 3}, {1, 5}, {2, 5}, {3, 5}}};
  LinkTriangulation<int> triangulation;
  EXPECT_EQ(triangulation.find(6, objective), 0);
  std::vector<LinkTriangle> triangles;
  triangulation.triangles(6, triangles);
  ASSERT_EQ(triangles.size(), 4u);
  for (const LinkTriangle& t : triangles) EXPECT_EQ(std::count(t.begin(), t.end(), 4), 1);
}

TEST(LinkTriangulation, CountsForbiddenDiagonalsThatCannotBeAvoided) {
  CountDiagonals objective{{{0, 2}, {1, 3}}};
  LinkTriangulation<int> triangulation;
  EXPECT_EQ(triangulation.find(4, objective), 1);
}

struct Never : CountDiagonals {
  std::optional<Cost> triangle(std::size_t i, std::size_t, std::size_t) {
    return i == 0 ? std::nullopt : std::optional(0);
  }
};

TEST(LinkTriangulation, FindsNothingIfThereIsNothing) {
  Never objective;
  LinkTriangulation<int> triangulation;
  EXPECT_EQ(triangulation.find(5, objective), std::nullopt);
}

TEST(EdgeShell, GoesRoundCounterclockwiseAndStopsAtTheHull) {
  TetMesh mesh = delaunay_of(spindle(7, 0.2));
  const Tet t = find_edge(mesh, 0, 1);
  ASSERT_NE(t, kNone);
  EdgeShell shell;
  ASSERT_TRUE(gather_shell(mesh, t, 0, 1, shell));
  ASSERT_EQ(shell.size(), 7u);
  for (std::size_t k = 0; k < 7; ++k) {
    const Vertex p = shell.link[k], q = shell.link[(k + 1) % 7];
    EXPECT_GT(mesh.orient(0, 1, p, q), 0);
    EXPECT_GE(mesh.index_of(shell.tets[k], p), 0);
    EXPECT_GE(mesh.index_of(shell.tets[k], q), 0);
  }
  EXPECT_FALSE(gather_shell(mesh, t, 0, 1, shell, 6));
  const Vertex corner = 9;
  const Tet s = find_edge(mesh, corner, corner + 1);
  ASSERT_NE(s, kNone);
  EXPECT_FALSE(gather_shell(mesh, s, corner, corner + 1, shell));
}

// Neither a segment nor a facet has a cost among vertices that are marked as disjoint from it.
TEST(Target, CostsNothingWhereItCannotBeMet) {
  std::mt19937_64 random(7);
  std::vector<Point> points;
  for (int k = 0; k < 60; ++k)
    points.push_back({static_cast<double>(random() % 9) - 4, static_cast<double>(random() % 9) - 4,
                      static_cast<double>(random() % 9) - 4});
  TetMesh mesh;
  for (const Point& p : points) MeshEditor(mesh).add_vertex(p);
  const auto any = [&] { return static_cast<Vertex>(random() % points.size()); };
  int met = 0, costly = 0, kept_off = 0;
  for (int k = 0; k < 4000; ++k) {
    EdgeShell shell;
    shell.a = any();
    shell.b = any();
    for (int i = 0; i < 3; ++i) shell.link.push_back(any());
    const Target target = k % 2 == 0 ? Target::segment(any(), any()) : Target::facet({any(), any(), any()});
    const int cost = target.edge(mesh, shell.a, shell.b) + target.edge(mesh, shell.link[0], shell.link[1]) +
                     target.face(mesh, shell.a, shell.b, shell.link[2]) +
                     target.face(mesh, shell.link[0], shell.link[1], shell.link[2]);
    ShellSigns signs(mesh);
    signs.set(shell);
    const bool may_meet = target.may_meet(mesh, signs.low(), signs.high());
    EXPECT_TRUE(may_meet || cost == 0);
    ++(may_meet ? met : kept_off);
    costly += cost > 0 ? 1 : 0;
  }
  EXPECT_GT(met, 0);
  EXPECT_GT(costly, 0);
  EXPECT_GT(kept_off, 0);
  EXPECT_FALSE(Target::none().may_meet(mesh, {-10, -10, -10}, {10, 10, 10}));
}

// Removing the axis must recover a facet of its link: every facet between three of seven ring vertices.
TEST(Recover, FacetsThatOneEdgePierces) {
  const std::vector<Point> points = spindle(7, 0.2);
  int missing = 0;
  for (Index i = 2; i < 9; ++i)
    for (Index j = i + 1; j < 9; ++j)
      for (Index k = j + 1; k < 9; ++k) {
        const std::vector<Triangle> facets{{i, j, k}};
        Recovered run = recover(points, facets, {});
        missing += run.stats.missing_facets == 1;
        EXPECT_EQ(run.standing.missing_segments(), 0u) << i << j << k;
        EXPECT_EQ(run.standing.missing_facets(), 0u) << i << j << k;
        const Face f = find_face(run.mesh, i, j, k);
        ASSERT_NE(f, kNone);
        EXPECT_TRUE(run.mesh.is_facet(f));
      }
  EXPECT_GT(missing, 10);
}

TEST(Recover, SegmentThroughOneFace) {
  // The 2-3 flip: apexes far apart, so that Delaunay prefers the face.
  const std::vector<Point> points{{1, 0, 0}, {-0.5, 0.8, 0}, {-0.5, -0.8, 0}, {0.1, 0, 3}, {0, 0.1, -3}};
  Recovered run = recover(points, {}, {{3, 4}});
  EXPECT_EQ(run.stats.missing_segments, 1u);
  EXPECT_EQ(run.standing.missing_segments(), 0u);
  EXPECT_GE(run.stats.face_flips, 1u);
  const Tet t = find_edge(run.mesh, 3, 4);
  ASSERT_NE(t, kNone);
  EXPECT_TRUE(run.mesh.is_segment(t, kEdgeOf[static_cast<std::size_t>(run.mesh.index_of(t, 3))]
                                            [static_cast<std::size_t>(run.mesh.index_of(t, 4))]));
}

TEST(Recover, SegmentThroughAnEdge) {
  // Four coplanar points: the long diagonal crosses the short one in a point.
  const std::vector<Point> points{{-2, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1.5}, {0, 0, -1.5}};
  Recovered run = recover(points, {}, {{0, 1}});
  EXPECT_EQ(run.stats.missing_segments, 1u);
  EXPECT_EQ(run.standing.missing_segments(), 0u);
}

// Schönhardt's prism, twisted too far to be filled: some facet or segment must stay missing, standing
// constraints are protected, and nothing breaks.
TEST(Recover, LeavesConstraintsWithoutASolution) {
  std::vector<Point> points;
  for (int k = 0; k < 6; ++k) {
    const double angle = 3.14159265358979 / 180 * (120. * k + (k < 3 ? 0 : 30));
    points.push_back({std::cos(angle), std::sin(angle), k < 3 ? -1. : 1.});
  }
  // Each side quadrilateral i, i+1, i'+1, i' takes its diagonal so that it is reflex.
  std::vector<Triangle> facets{{0, 1, 2}, {3, 4, 5}};
  for (Index k = 0; k < 3; ++k) {
    const Index l = (k + 1) % 3;
    facets.push_back({k, l, l + 3});
    facets.push_back({k, l + 3, k + 3});
  }
  std::vector<Triangle> other{{0, 1, 2}, {3, 4, 5}};
  for (Index k = 0; k < 3; ++k) {
    const Index l = (k + 1) % 3;
    other.push_back({k, l, k + 3});
    other.push_back({l, l + 3, k + 3});
  }
  const Recovered one = recover(points, facets, {});
  const Recovered two = recover(points, other, {});
  const auto left = [](const Recovered& r) {
    return r.standing.missing_segments() + r.standing.missing_facets();
  };
  EXPECT_TRUE((left(one) == 0) != (left(two) == 0));
}

TEST(Piercing, AgreesWithAnExhaustiveSearch) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<Point> points;
  for (int k = 0; k < 60; ++k) points.push_back({u(random), u(random), u(random)});
  // A grid inside, so that segments cross edges, too.
  for (int k = 0; k < 27; ++k)
    points.push_back({0.25 * (k % 3 - 1), 0.25 * (k / 3 % 3 - 1), 0.25 * (k / 9 - 1)});
  TetMesh mesh = delaunay_of(points);
  Piercing piercing(mesh, random);
  std::size_t through_edges = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const auto a = static_cast<Vertex>(random() % points.size()),
               b = static_cast<Vertex>(trial % 2 == 0 ? random() % points.size() : 60 + random() % 27);
    if (a == b) continue;
    std::vector<Crossing> found;
    const std::optional<Tet> reached = piercing.by_segment(a, b, found, 10000);
    EXPECT_EQ(reached && found.empty(), find_edge(mesh, a, b) != kNone);
    if (reached && found.empty()) {
      EXPECT_TRUE(mesh.index_of(*reached, a) >= 0 && mesh.index_of(*reached, b) >= 0);
    }
    EXPECT_EQ(piercing.find_edge(a, b) != kNone, find_edge(mesh, a, b) != kNone);
    if (!reached) continue;  // a grid point lies between
    const Target target = Target::segment(a, b);
    int expected = 0, cost = 0;
    for (Tet t = 0; t < mesh.slot_count(); ++t) {
      if (!mesh.alive(t) || mesh.is_ghost(t)) continue;
      for (int i = 0; i < 4; ++i) {
        const auto f = mesh.face_vertices(face_code(t, i));
        if (face_code(t, i) < mesh.neighbour(t, i)) expected += target.face(mesh, f[0], f[1], f[2]);
      }
    }
    for (const Crossing& c : found) {
      if (c.count == 2) {
        EXPECT_EQ(target.edge(mesh, c.corners[0], c.corners[1]), Target::kEdgeCost);
        ++through_edges;
      } else {
        cost += target.face(mesh, c.corners[0], c.corners[1], c.corners[2]);
      }
    }
    EXPECT_EQ(cost, expected);
  }
  EXPECT_GT(through_edges, 50u);
}

// A large triangle and clouds of points close above and below it.
std::vector<Point> clouds_round_a_triangle(std::size_t count, unsigned seed) {
  std::vector<Point> points{{-5, -4, 0}, {5, -4, 0}, {0, 6, 0}};
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> wide(-1.5, 1.5), high(0.02, 0.5);
  for (std::size_t k = 0; k < count; ++k)
    points.push_back({wide(random), wide(random), k % 2 == 0 ? high(random) : -high(random)});
  return points;
}

std::size_t count_segment_bits(const TetMesh& mesh) {
  std::size_t count = 0;
  for (Tet t = 0; t < mesh.slot_count(); ++t)
    for (int k = 0; k < 6; ++k)
      if (mesh.alive(t) && mesh.is_segment(t, k)) ++count;
  return count;
}

TEST(FacetCavities, RecoverAFacetThatHundredsOfEdgesPierce) {
  const Triangle facet{0, 1, 2};
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Recovered run = recover(clouds_round_a_triangle(600, seed), {facet}, {});
    ASSERT_EQ(run.standing.missing_segments(), 0u);
    ASSERT_EQ(run.standing.missing_facets(), 1u) << "few enough edges for flips";
    FacetCavities cavities(run.mesh, seed);
    EXPECT_GT(cavities.crossing(facet), 200u);
    const std::size_t vertices = run.mesh.vertex_count();
    ASSERT_TRUE(cavities.recover(facet, [] {}));
    EXPECT_EQ(find_fault(run.mesh), "");
    EXPECT_EQ(run.mesh.vertex_count(), vertices);
    const Face face = find_face(run.mesh, 0, 1, 2);
    ASSERT_NE(face, kNone);
    EXPECT_TRUE(run.mesh.is_facet(face) && run.mesh.is_facet(run.mesh.neighbour(face)));
    EXPECT_EQ(cavities.crossing(facet), 0u);
    for (Vertex v = 0; v < vertices; ++v) EXPECT_TRUE(run.mesh.in_mesh(v));
  }
}

TEST(FacetCavities, KeepSegmentsInsideTheCavities) {
  std::vector<Point> points = clouds_round_a_triangle(600, 1);
  const auto first = static_cast<Index>(points.size());
  points.insert(points.end(), {{-0.2, 0, 0.7}, {0.2, 0, 0.7}, {-0.2, 0.1, -0.7}, {0.2, 0.1, -0.7}});
  const Triangle facet{0, 1, 2};
  Recovered run = recover(points, {facet}, {{first, first + 1}, {first + 2, first + 3}});
  ASSERT_EQ(run.standing.missing_segments(), 0u);
  ASSERT_TRUE(FacetCavities(run.mesh, 1).recover(facet, [] {}));
  EXPECT_EQ(find_fault(run.mesh), "");  // with every segment bit in the whole shell of an edge
  EXPECT_GT(count_segment_bits(run.mesh), 0u);
  EXPECT_NE(find_edge(run.mesh, first, first + 1), kNone);
  EXPECT_NE(find_edge(run.mesh, first + 2, first + 3), kNone);
}

TEST(FacetCavities, NameVerticesInTheFacet) {
  std::vector<Point> points = clouds_round_a_triangle(600, 1);
  const auto inside = static_cast<Vertex>(points.size());
  points.push_back({0.1, 0.2, 0});
  const Triangle facet{0, 1, 2};
  Recovered run = recover(points, {}, {{0, 1}, {1, 2}, {2, 0}});
  ASSERT_EQ(run.standing.missing_segments(), 0u);
  FacetCavities cavities(run.mesh, 1);
  const std::size_t tets = run.mesh.tet_count();
  EXPECT_FALSE(cavities.recover(facet, [] {}));
  EXPECT_EQ(cavities.in_the_way(), std::vector<Vertex>{inside});
  EXPECT_EQ(run.mesh.tet_count(), tets);
  EXPECT_EQ(find_fault(run.mesh), "");
}

// A vertex very close to its nearest doubles, which may be those of another vertex.
Vertex add_beside(TetMesh& mesh, const Point& p) {
  exact::ExactPoint e = exact::lift(p.data());
  for (exact::Dyadic& x : e.c) x += exact::Dyadic(1).scaled(-120);
  return MeshEditor(mesh).add_vertex(e);
}

TEST(InsertVertex, InsideATetrahedronAFaceAnEdgeAndBesideAVertex) {
  std::uint32_t random = 1;
  for (const Point& p : {Point{1.3, 1.4, 1.1}, Point{1, 1, 1.25}, Point{1, 1, 1}, Point{1.25, 1, 1}}) {
    TetMesh mesh = delaunay_of({{1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}});
    const Vertex v = add_beside(mesh, p);
    ASSERT_FALSE(mesh.is_explicit(v));
    ASSERT_TRUE(insert_vertex(mesh, v, random));
    EXPECT_EQ(find_fault(mesh), "");
    EXPECT_TRUE(mesh.in_mesh(v));
    const Vertex w =
        MeshEditor(mesh).add_vertex(Point{1.125, 1.125, 1});  // with doubles, in a face or on an edge
    ASSERT_TRUE(insert_vertex(mesh, w, random));
    EXPECT_EQ(find_fault(mesh), "");
  }
}

TEST(InsertVertex, NotOutsideNorOnTheHull) {
  std::uint32_t random = 1;
  TetMesh mesh = delaunay_of({{0, 0, 0}});
  const std::size_t tets = mesh.tet_count();
  for (const Point& p : {Point{0, 0, 20}, Point{1, 2, 10}, Point{10, 10, 0}}) {
    EXPECT_FALSE(insert_vertex(mesh, MeshEditor(mesh).add_vertex(p), random));
    EXPECT_EQ(mesh.tet_count(), tets);
  }
}

// Vertices that are not doubles, close above and below the facet, some with the nearest doubles of others.
TEST(FacetCavities, HoldVerticesWithoutDoubles) {
  const Triangle facet{0, 1, 2};
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const std::vector<Point> points = clouds_round_a_triangle(600, seed);
    Recovered run = recover(points, {facet}, {});
    ASSERT_EQ(run.standing.missing_facets(), 1u);
    std::uint32_t random = seed;
    std::vector<Vertex> inexact;
    for (const Point& p : {points[3], points[4], Point{0.1, 0.2, 0}, Point{-0.3, 0.1, 0}}) {
      inexact.push_back(add_beside(run.mesh, p));
      ASSERT_TRUE(insert_vertex(run.mesh, inexact.back(), random));
    }
    ASSERT_EQ(find_fault(run.mesh), "");
    FacetCavities cavities(run.mesh, seed);
    ASSERT_TRUE(cavities.recover(facet, [] {}));
    EXPECT_EQ(find_fault(run.mesh), "");
    EXPECT_NE(find_face(run.mesh, 0, 1, 2), kNone);
    for (const Vertex v : inexact) EXPECT_TRUE(run.mesh.in_mesh(v) && !run.mesh.is_explicit(v));
  }
}

// The vertices of the hull of the points and others, of those that come first.
std::size_t on_hull(const std::vector<Point>& points, const std::vector<Point>& others) {
  TetMesh mesh;
  for (const Point& p : points) MeshEditor(mesh).add_vertex(p);
  for (const Point& p : others) MeshEditor(mesh).add_vertex(p);
  EXPECT_TRUE(build_delaunay(mesh, {}, nullptr));
  std::set<Vertex> hull;
  for (Tet t = 0; t < mesh.slot_count(); ++t)
    if (mesh.alive(t) && mesh.is_ghost(t)) hull.insert(mesh.corners(t).begin(), mesh.corners(t).end());
  return static_cast<std::size_t>(
      std::count_if(hull.begin(), hull.end(), [&](Vertex v) { return v < points.size(); }));
}

// No constraint can be enforced on a hull. A surface of furniture crashed.
TEST(FarPoints, HoldACavityOfAnInclinedFacet) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> wide(-1.5, 1.5), high(1e-6, 0.1);
  std::size_t narrow = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Point> points{{-2, -1, 0}, {1.5, -1, 0}, {0, 2, 0}};
    for (int k = 0; k < 60; ++k) points.push_back({wide(random), wide(random), high(random)});
    const double a = wide(random), b = 2 * wide(random);
    for (Point& p : points) {
      p = {p[0], std::cos(a) * p[1] - std::sin(a) * p[2], std::sin(a) * p[1] + std::cos(a) * p[2]};
      p = {std::cos(b) * p[0] - std::sin(b) * p[2], p[1], std::sin(b) * p[0] + std::cos(b) * p[2]};
    }
    narrow += on_hull(points, far_points(points, {0, 1, 2})) > 0 ? 1 : 0;
    EXPECT_EQ(on_hull(points, far_points_all_round(points, {0, 1, 2})), 0u) << trial;
  }
  EXPECT_GT(narrow, 0u);
}

TEST(FacetCavities, RestoreTheMeshIfTheyGiveUp) {
  const Triangle facet{0, 1, 2};
  Recovered run = recover(clouds_round_a_triangle(600, 2), {facet}, {});
  FacetCavities cavities(run.mesh, 1);
  EXPECT_FALSE(cavities.recover({0, 1, 3}, [] {})) << "its sides are not edges";
  EXPECT_THROW(cavities.recover(facet, [] { throw std::runtime_error("stop"); }), std::runtime_error);
  EXPECT_EQ(find_fault(run.mesh), "");
  EXPECT_EQ(find_face(run.mesh, 0, 1, 2), kNone);
  EXPECT_TRUE(cavities.recover(facet, [] {}));
}

TEST(TriedEdges, AnEdgeIsTriedAgainOnlyWithMoreLevels) {
  TriedEdges tried;
  EXPECT_TRUE(tried.add(3, 7, 2));
  EXPECT_FALSE(tried.add(7, 3, 2)) << "the same edge";
  EXPECT_FALSE(tried.add(3, 7, 1));
  EXPECT_TRUE(tried.add(3, 7, 4));
  EXPECT_FALSE(tried.add(3, 7, 3));
  tried.forget();
  EXPECT_TRUE(tried.add(3, 7, 1));
}

TEST(TriedEdges, GrowsWithoutLosingAny) {
  TriedEdges tried;
  tried.add(1, 2, 9);
  tried.forget();
  constexpr Vertex kMany = 60;
  for (Vertex a = 0; a < kMany; ++a)
    for (Vertex b = a + 1; b < kMany; ++b) ASSERT_TRUE(tried.add(a, b, 1)) << a << ' ' << b;
  for (Vertex a = 0; a < kMany; ++a)
    for (Vertex b = a + 1; b < kMany; ++b) ASSERT_FALSE(tried.add(b, a, 1)) << a << ' ' << b;
}

}  // namespace
}  // namespace holdfast::recover_test
