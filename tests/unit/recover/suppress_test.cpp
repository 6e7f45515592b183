// Suppression: removal, moves and growth, each compared with exhaustive search; constraints never move.
#include "suppress/suppress.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "enforce/enforce.h"
#include "hard_surfaces.h"
#include "suppress/degree.h"
#include "suppress/needed.h"
#include "suppress/refill.h"
#include "suppress/remove_or_recentre.h"
#include "suppress/shake.h"
#include "unit/suppress_scenes.h"

namespace holdfast::suppress_test {
namespace {

using namespace testing;

// --- meshes with Steiner points

// Slightly off every double, as the apexes of thin sectors are.
void make_exact(TetMesh& mesh, Vertex p) {
  exact::ExactPoint x = mesh.exact_position(p);
  x.c[1] += exact::Dyadic(1, -70);
  MeshEditor(mesh).move_vertex(p, x);
}

bool can_collapse(TetMesh& mesh, Vertex p) {
  const Faces faces = outer_faces(mesh, ball_of(mesh, p));
  const std::vector<Vertex> link = link_vertices(mesh, p);
  return std::any_of(link.begin(), link.end(), [&](Vertex v) { return all_positive(mesh, cone(faces, v)); });
}

TEST(RemoveOrRecentre, DoesTheFirstPossibleStep) {
  std::map<Fate, int> fates;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scene s = scene(30, 40, 0.1 * static_cast<double>(seed), seed);
    for (const Vertex p : s.steiner()) {
      make_exact(s.mesh, p);
      const bool collapsible = can_collapse(s.mesh, p);
      const Faces faces = outer_faces(s.mesh, ball_of(s.mesh, p));
      const bool fillable = fill_polyhedron(s.mesh, faces).has_value();
      const Kernel kernel = kernel_of(s.mesh, faces);
      const Fate fate = remove_or_recentre(s.mesh, p, {});
      ++fates[fate];
      EXPECT_EQ(fate, collapsible ? Fate::collapsed : fillable ? Fate::filled : Fate::moved);
      EXPECT_EQ(s.mesh.in_mesh(p), fate == Fate::moved);
      if (fate != Fate::moved) continue;
      EXPECT_TRUE(kernel.holds(s.mesh.point(p)));
      EXPECT_TRUE(s.mesh.is_explicit(p));
    }
    s.expect_kept();
  }
  EXPECT_GT(fates[Fate::collapsed], 20);
  EXPECT_GT(fates[Fate::filled], 5);
  EXPECT_GT(fates[Fate::moved], 5);
}

TEST(LowerDegree, ReportsWhetherTheDegreeFell) {
  int fell = 0, four = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Scene s = scene(30, 40, seed % 2 == 0 ? 1 : 0, seed);
    Random random(seed);
    Flipper flipper(s.mesh, random);
    std::vector<Vertex> twice = s.steiner();
    twice.insert(twice.end(), twice.begin(), twice.end());
    for (const Vertex p : twice) {
      const std::size_t before = link_vertices(s.mesh, p).size();
      const bool lower = lower_degree(s.mesh, flipper, p, 2, 300);
      const std::size_t after = link_vertices(s.mesh, p).size();
      ASSERT_EQ(lower, after < before);
      ++(lower ? fell : refused);
      four += after == 4 ? 1 : 0;
    }
    s.expect_kept();
  }
  EXPECT_GT(fell, 50);
  EXPECT_GT(four, 20);
  EXPECT_GT(refused, 5);
}

TEST(Shake, ChangesTheMeshRoundAPointAndNothingElse) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Scene s = scene(30, 40, 0.25 * static_cast<double>(seed - 1), seed);
    Random random(seed);
    Flipper flipper(s.mesh, random);
    int changed = 0;
    const std::vector<Vertex> points = s.steiner();
    for (const Vertex p : points) {
      const std::vector<Vertex> before = link_vertices(s.mesh, p);
      shake(s.mesh, flipper, p, 20, random);
      changed += link_vertices(s.mesh, p) != before ? 1 : 0;
    }
    EXPECT_GT(changed, 10) << seed;
    EXPECT_EQ(s.steiner(), points);
    s.expect_kept();
  }
}

// --- filling again

// Runs an operation on the Steiner points of some scenes; if it fails, nothing may have changed.
void expect_all_or_nothing(const std::function<bool(Scene&, Vertex, Random&)>& operation) {
  int done = 0, failed = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scene s = scene(30, 30, seed % 2 == 0 ? 0.3 : 1, seed);
    Random random(seed);
    for (const Vertex p : s.steiner()) make_exact(s.mesh, p);
    for (const Vertex p : s.steiner()) {
      if (!s.mesh.in_mesh(p)) continue;
      const TetMesh before = s.mesh;
      const bool success = operation(s, p, random);
      ++(success ? done : failed);
      EXPECT_TRUE(success || difference(s.mesh, before).empty());
      s.expect_kept();
    }
  }
  EXPECT_GT(done, 20);
  EXPECT_GT(failed, 5);
}

TEST(RefillWithout, RemovesThePointOrChangesNothing) {
  expect_all_or_nothing([](Scene& s, Vertex p, Random& random) {
    const bool done = refill_without(s.mesh, p, s.first_free, {.attempts = 1, .steps = 1}, random);
    EXPECT_EQ(done, !s.mesh.in_mesh(p));
    return done;
  });
}

TEST(Merge, RemovesTheNeighbourOrBothOrChangesNothing) {
  int one = 0, both = 0;
  expect_all_or_nothing([&](Scene& s, Vertex p, Random& random) {
    const PolyhedronOptions search{.most_vertices = random() % 2 == 0 ? 4u : 20u, .most_nodes = 200};
    for (const Vertex q : link_vertices(s.mesh, p)) {
      if (q < s.first_free) continue;
      const bool done = merge(s.mesh, p, q, s.first_free, 4, search);
      const bool stays = s.mesh.in_mesh(p);
      EXPECT_EQ(done, !s.mesh.in_mesh(q));
      EXPECT_TRUE(done ? !stays || s.mesh.is_explicit(p) : stays);
      one += done && stays ? 1 : 0;
      both += stays ? 0 : 1;
      return done;
    }
    return false;
  });
  EXPECT_GT(one, 5);
  EXPECT_GT(both, 5);
}

// A Steiner point in a tetrahedron one unit in the last place thick: no double lies inside.
Scene sliver(bool closed_off) {
  Scene s;
  const double above = std::nextafter(1.0, 2.0);
  const std::vector<Point> points{{1, 0, 1}, {0, 1, above}, {-1, 0, 1}, {0, -1, above}};
  s.mesh = delaunay_in_box(points, 4);
  s.first_free = static_cast<Vertex>(s.mesh.vertex_count());
  const std::vector<Tet> thin = living_with(s.mesh, {0, 1, 2, 3});
  EXPECT_EQ(thin.size(), 1u);
  if (closed_off)
    for (int i = 0; i < 4; ++i) constrain(s.mesh, thin[0], i);
  const Vertex p = MeshEditor(s.mesh).add_vertex(
      exact::ExactPoint{{0.0, 0.0, exact::Dyadic(1.0) + exact::Dyadic(1, -53)}});
  const std::vector<TetMesh::Corners> fresh = cone(outer_faces(s.mesh, thin), p);
  MeshEditor(s.mesh).replace({.old_tets = thin, .new_tets = fresh});
  s.remember();
  return s;
}

TEST(RoundWithNeighbours, GrowsTheBallUntilADoubleFits) {
  Scene s = sliver(false);
  const Vertex p = s.first_free;
  ASSERT_FALSE(s.mesh.is_explicit(p));
  const TetMesh before = s.mesh;
  EXPECT_FALSE(round_with_neighbours(s.mesh, p, s.first_free, 0));
  EXPECT_EQ(difference(s.mesh, before), "");
  EXPECT_TRUE(round_with_neighbours(s.mesh, p, s.first_free, 30));
  EXPECT_TRUE(s.mesh.is_explicit(p));
  EXPECT_GT(ball_of(s.mesh, p).size(), 4u);
  s.expect_kept();
}

TEST(RoundWithNeighbours, NeverGrowsAcrossAFacet) {
  Scene s = sliver(true);
  const TetMesh before = s.mesh;
  EXPECT_FALSE(round_with_neighbours(s.mesh, s.first_free, s.first_free, 30));
  EXPECT_EQ(difference(s.mesh, before), "");
  s.expect_kept();
}

// --- the whole stage

SuppressStats suppress_all(Scene& s) {
  const Options options;
  Monitor monitor(options);
  const std::size_t before = s.steiner().size();
  const SuppressStats stats = suppress(s.mesh, s.steiner(), s.first_free, monitor);
  s.expect_kept();
  EXPECT_EQ(stats.left, s.steiner().size());
  EXPECT_EQ(stats.collapsed + stats.filled + stats.merged + stats.left, before);
  EXPECT_EQ(stats.unrounded, s.mesh.exact_vertex_count());
  return stats;
}

TEST(Suppress, LeavesFewPointsAndAllInDoubles) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Scene s = scene(40, 60, 0.25 * static_cast<double>(seed - 1), seed);
    for (const Vertex p : s.steiner()) make_exact(s.mesh, p);
    const SuppressStats stats = suppress_all(s);
    EXPECT_EQ(stats.left, 0u) << seed;
    EXPECT_EQ(stats.unrounded, 0u) << seed;
  }
  Scene thin = sliver(true);
  EXPECT_EQ(suppress_all(thin).left, 0u);
}

// The mesh of a surface in a box, by partition and elimination.
Scene enforced(const std::vector<Point>& points, const std::vector<Triangle>& facets, std::uint64_t seed) {
  Scene s;
  s.mesh = delaunay_in_box(points, 40);
  s.first_free = static_cast<Vertex>(s.mesh.vertex_count());
  const SegmentTable table = segment_table({points, facets, {}, {}, {}});
  Standing standing = mark_present(s.mesh, table);
  const Options options;
  Monitor monitor(options);
  enforce(s.mesh, {table, facets, standing}, s.first_free, {.seed = seed, .flips = false}, monitor);
  EXPECT_EQ(facet_faces(s.mesh).size(), facets.size());
  s.remember();
  return s;
}

Scene enforced(const Polyhedron& p) {
  return enforced({p.mesh.positions().begin(), p.mesh.positions().end()}, p.faces, 1);
}

TEST(Suppress, MergesPointsOfChazellesPolyhedron) {
  const Surface surface = hard::chazelle(3);
  std::size_t merged = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scene s = enforced(surface.vertices, surface.facets, seed);
    const SuppressStats stats = suppress_all(s);
    merged += stats.merged;
    EXPECT_EQ(stats.unrounded, 0u);
  }
  EXPECT_GT(merged, 0u);
}

TEST(Suppress, LeavesSchoenhardtOnePointThatItNeeds) {
  for (const double part : {0.1, 0.5, 0.9}) {
    Scene bent_in = enforced(twisted_prism(part * kMostTwist, 1));
    EXPECT_EQ(suppress_all(bent_in).left, 1u) << part;
    EXPECT_EQ(bent_in.mesh.exact_vertex_count(), 0u);
    Scene convex = enforced(twisted_prism(-part * kMostTwist, 1));
    EXPECT_EQ(suppress_all(convex).left, 0u) << part;
  }
}

// Meshes a convex prism from a point in its middle.
Vertex add_centre(Scene& prism) {
  std::vector<Tet> inside = living(prism.mesh);
  std::erase_if(inside, [&](Tet t) {
    const auto& c = prism.mesh.corners(t);
    return std::any_of(c.begin(), c.end(), [](Vertex v) { return v >= 6; });
  });
  const Vertex p = MeshEditor(prism.mesh).add_vertex(Point{0, 0, 0.5});
  const auto fresh = cone(outer_faces(prism.mesh, inside), p);
  MeshEditor(prism.mesh).replace({.old_tets = inside, .new_tets = fresh});
  return p;
}

TEST(IsNeeded, IsProvenOfSchoenhardtsPointAndOfNoRemovableOne) {
  for (const double part : {0.1, 0.5, 0.9}) {
    Scene bent_in = enforced(twisted_prism(part * kMostTwist, 1));
    suppress_all(bent_in);
    ASSERT_EQ(bent_in.steiner().size(), 1u);
    EXPECT_TRUE(is_needed(bent_in.mesh, bent_in.steiner()[0], bent_in.first_free)) << part;
    bent_in.expect_kept();
    Scene convex = enforced(twisted_prism(-part * kMostTwist, 1));
    EXPECT_FALSE(is_needed(convex.mesh, add_centre(convex), convex.first_free)) << part;
    EXPECT_EQ(suppress_all(convex).left, 0u);
  }
}

// A filling would have to keep a segment inside: then nothing is proven.
TEST(IsNeeded, IsNotProvenWithAConstraintInside) {
  Scene s = enforced(twisted_prism(0.5 * kMostTwist, 1));
  suppress_all(s);
  const Vertex p = s.steiner().at(0);
  const Tet t = s.mesh.incident(p);
  const int i = s.mesh.index_of(t, p);
  const Vertex q = s.mesh.corner(t, (i + 1) % 4);
  MeshEditor(s.mesh).set_segment(t, p, q);
  EXPECT_FALSE(is_needed(s.mesh, p, s.first_free));
}

TEST(Suppress, CanBeStoppedAndLeavesAValidMesh) {
  Scene s = scene(40, 60, 0.5, 9);
  Options options;
  options.time_limit = 1e-9;
  Monitor monitor(options);
  EXPECT_THROW(suppress(s.mesh, s.steiner(), s.first_free, monitor), Interrupted);
  s.expect_kept();
}

}  // namespace
}  // namespace holdfast::suppress_test
