// Optimisation: the worst elements improve, constraints and volume stay, the mesh is valid after every step.
#include "optimise/optimise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "mesh/assembly.h"
#include "mesh/quality.h"
#include "mesh/validate.h"
#include "mesh_fixtures.h"
#include "optimise/badness.h"
#include "optimise/exchange_for_quality.h"
#include "optimise/insert_point.h"
#include "optimise/reconnect.h"
#include "optimise/relocate.h"
#include "optimise/remove_flat.h"
#include "optimise/search.h"
#include "optimise/shaking.h"

namespace holdfast::optimise_test {
namespace {

using namespace testing;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double worst_quality(const TetMesh& mesh) { return badness_of(mesh, solid(mesh), {kInfinity}).worst; }

// Facets and segments on some inner faces, as obstacles.
void constrain(TetMesh& mesh, std::mt19937_64& random) {
  for (const Tet t : solid(mesh)) {
    if (random() % 12 != 0) continue;
    const Face f = face_code(t, static_cast<int>(random() % 4));
    if (mesh.is_ghost(tet_of(mesh.neighbour(f)))) continue;
    MeshEditor(mesh).set_facet(f);
    const auto v = mesh.face_vertices(f);
    for (std::size_t k = 0; k < 3; ++k)
      MeshEditor(mesh).set_segment(find_edge(mesh, v[k], v[(k + 1) % 3]), v[k], v[(k + 1) % 3]);
  }
}

// A flat tetrahedron, the worst of a mesh.
Tet worst_tet(const TetMesh& mesh) {
  const std::vector<Tet> tets = solid(mesh);
  return *std::max_element(tets.begin(), tets.end(), [&](Tet s, Tet t) {
    return quality_of(mesh, mesh.corners(s)) < quality_of(mesh, mesh.corners(t));
  });
}

void expect_sound(TetMesh& mesh, const exact::Dyadic& volume) {
  EXPECT_EQ(find_fault(mesh), "");
  EXPECT_EQ((volume_of(mesh) - volume).sign(), 0);
}

TEST(Badness, FewerFlatOnesCountFirst) {
  Badness flat, thin;
  flat.add(1e12, {1000});
  thin.add(900, {1000});
  thin.add(900, {1000});
  EXPECT_EQ(flat.flat, 1u);
  EXPECT_EQ(thin.flat, 0u);
  EXPECT_TRUE(thin.is_worthwhile_after(flat));
  EXPECT_FALSE(flat.is_worthwhile_after(thin));
  Badness other;
  other.add(890, {1000});
  EXPECT_FALSE(other.is_worthwhile_after(thin));  // too little
  Badness not_a_number;
  not_a_number.add(std::nan(""), {1000});
  EXPECT_EQ(not_a_number.flat, 1u);
}

TEST(Badness, NoElementBecomesHopelessForFewerFlatOnes) {
  const BadFrom from{100, 1000};
  Badness cap, parted;  // a cap, and the three tetrahedra after a point is added
  cap.add(1e12, from);
  for (int k = 0; k < 3; ++k) parted.add(400, from);
  EXPECT_TRUE(parted.is_worthwhile_after(cap));
  EXPECT_FALSE(cap.is_worthwhile_after(parted));
  EXPECT_TRUE(parted < cap);
  const Badness both = join(cap, parted);
  EXPECT_EQ(both.hopeless, 1u);
  EXPECT_EQ(both.flat, 4u);
  EXPECT_EQ(both.worst, 1e12);
}

TEST(Badness, NullOnesCountFirstAndMayBecomeFlat) {
  const BadFrom from{100, 1000, 1e10};
  Badness null, flat;
  null.add(1e15, from);
  for (int k = 0; k < 3; ++k) flat.add(1e6, from);
  EXPECT_TRUE(flat.is_worthwhile_after(null));
  EXPECT_FALSE(null.is_worthwhile_after(flat));
  EXPECT_EQ(from.limit_for(1e15), 1e10);
  EXPECT_EQ(from.limit_for(1e6), 100);
  EXPECT_EQ(from.limit_for(50), tuning::kLeastGain * 50);
}

TEST(Badness, WideEdgesOfASliverAndOfACap) {
  TetMesh mesh;
  for (const Point& p : {Point{0, 0, 0}, Point{1, 0, 1e-9}, Point{1, 1, 0}, Point{0, 1, 1e-9}})
    MeshEditor(mesh).add_vertex(p);
  const Tet sliver = MeshAssembly(mesh).add_tet({0, 1, 2, 3});
  EXPECT_EQ(wide_edges(mesh, sliver), (std::vector<int>{1, 4}));  // the diagonals 02 and 13
  for (const Point& p : {Point{0, 0, 0}, Point{1, 0, 0}, Point{0, 1, 0}, Point{0.3, 0.3, 1e-9}})
    MeshEditor(mesh).add_vertex(p);
  const Tet cap = MeshAssembly(mesh).add_tet({4, 5, 6, 7});
  EXPECT_EQ(wide_edges(mesh, cap), (std::vector<int>{2, 4, 5}));  // those at vertex 7
}

TEST(Exchange, NeverWorseAndNothingLost) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    TetMesh mesh = slivers(1e-6, seed);
    std::mt19937_64 random(seed);
    constrain(mesh, random);
    const auto facets = facet_faces(mesh);
    const auto segments = segment_edges(mesh);
    const exact::Dyadic volume = volume_of(mesh);
    Qualities qualities(mesh);
    Exchanger exchanger(mesh, qualities, {1000});
    Badness before = badness_of(mesh, solid(mesh), {1000});
    int exchanged = 0;
    for (const Tet t : solid(mesh)) {
      if (!mesh.alive(t)) continue;
      std::vector<Tet> created;
      if (!exchanger.improve(t, created)) continue;
      qualities.forget(created);
      ++exchanged;
      const Badness after = badness_of(mesh, solid(mesh), {1000});
      EXPECT_LE(after.flat, before.flat);
      if (after.flat == before.flat) {
        EXPECT_LE(after.worst, before.worst);
      }
      before = after;
    }
    EXPECT_GT(exchanged, 0);
    EXPECT_EQ(facet_faces(mesh), facets);
    EXPECT_EQ(segment_edges(mesh), segments);
    expect_sound(mesh, volume);
  }
}

// Null ones count most, then hopeless, then flat ones, then the worst Q, even if the less important ones get
// worse.
TEST(Exchange, GoesDownInTheOrderOfBadness) {
  int more_of_a_lesser_kind = 0, worse_for_fewer = 0;
  for (std::uint64_t seed = 0; seed < 80; ++seed) {
    const BadFrom from = seed % 2 == 0 ? BadFrom{8, 1e3, 1e6} : BadFrom{5, 100, 1e4};
    TetMesh mesh = slivers(std::pow(10, -2 - static_cast<double>(seed / 2 % 6)), seed);
    Qualities qualities(mesh);
    Exchanger exchanger(mesh, qualities, from);
    Badness before = badness_of(mesh, solid(mesh), from);
    for (const Tet t : solid(mesh)) {
      std::vector<Tet> created;
      if (!mesh.alive(t) || !exchanger.improve(t, created)) continue;
      qualities.forget(created);
      const Badness after = badness_of(mesh, solid(mesh), from);
      const auto was = std::tuple(before.null, before.hopeless, before.flat);
      const auto is = std::tuple(after.null, after.hopeless, after.flat);
      EXPECT_LE(is, was);
      EXPECT_LE(is == was ? after.worst : 0, before.worst);
      const bool more =
          (after.null < before.null && (after.hopeless > before.hopeless || after.flat > before.flat)) ||
          (after.hopeless < before.hopeless && after.flat > before.flat);
      more_of_a_lesser_kind += more ? 1 : 0;
      worse_for_fewer += is < was && after.worst > before.worst ? 1 : 0;
      before = after;
    }
  }
  EXPECT_GT(more_of_a_lesser_kind, 0);
  EXPECT_GT(worse_for_fewer, 0);
}

// Tries the removal of each tetrahedron that is as bad as its limit, and counts the successes.
std::size_t remove_bad(double flatness, const std::function<double(double)>& limit_of, double least_limit) {
  std::size_t removed = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    TetMesh mesh = slivers(flatness, seed);
    const exact::Dyadic volume = volume_of(mesh);
    FlatRemover remover(mesh);
    for (const Tet t : solid(mesh)) {
      if (!mesh.alive(t)) continue;
      const double quality = quality_of(mesh, mesh.corners(t)), limit = limit_of(quality);
      if (quality < limit || limit < least_limit) continue;
      const std::size_t before = badness_of(mesh, solid(mesh), {limit}).flat;
      std::vector<Tet> created;
      const bool fewer = remover.remove(t, limit, created);
      const std::size_t after = badness_of(mesh, solid(mesh), {limit}).flat;
      EXPECT_LE(after, before);
      if (fewer) {
        EXPECT_LT(after, before);
        ++removed;
      }
    }
    expect_sound(mesh, volume);
  }
  return removed;
}

TEST(FlatRemover, LeavesFewerFlatOnes) {
  EXPECT_GT(remove_bad(
                1e-9, [](double) { return 1000; }, 0),
            20u);
}

// Whatever the limit: no new element is as bad as the removed one.
TEST(FlatRemover, MakesNothingAsBadAsTheRemovedElement) {
  EXPECT_GT(remove_bad(
                1e-2, [](double quality) { return 0.98 * quality; }, 5),
            20u);
}

TEST(Relocate, LowersTheWorstOfTheBall) {
  TetMesh mesh = delaunay_in_box(
      {{0.9, 0.9, -0.9}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, 1);
  std::mt19937_64 random(1);
  const std::vector<Tet> star = ball_of(mesh, 0);
  const double before = badness_of(mesh, star, {kInfinity}).worst;
  EXPECT_TRUE(relocate(mesh, 0, star, random));
  EXPECT_LT(badness_of(mesh, star, {kInfinity}).worst, 0.8 * before);
  EXPECT_EQ(find_fault(mesh), "");
}

TEST(Reconnect, OnlyBetterFillings) {
  std::mt19937_64 random(3);
  int reconnected = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    TetMesh mesh = slivers(1e-7, seed, 3);
    constrain(mesh, random);
    const auto facets = facet_faces(mesh);
    const exact::Dyadic volume = volume_of(mesh);
    const Badness before = badness_of(mesh, solid(mesh), {1000});
    std::vector<Tet> created;
    if (reconnect(mesh, worst_tet(mesh), kNone, {1000}, seed % 2 == 0, random, created)) {
      ++reconnected;
      EXPECT_LT(badness_of(mesh, solid(mesh), {1000}).flat, before.flat);
      EXPECT_LT(badness_of(mesh, created, {1000}).worst, 1000);
    }
    EXPECT_EQ(facet_faces(mesh), facets);
    expect_sound(mesh, volume);
  }
  EXPECT_GT(reconnected, 0);
}

// A corner of three facets that are coplanar up to rounding: only a point helps.
TEST(InsertPoint, OfThreeFacetsThatMakeACap) {
  TetMesh mesh = delaunay_in_box({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, -1}, {0.3, 0.3, 1}}, 2);
  const auto first_free = static_cast<Vertex>(mesh.vertex_count() + 1);
  const Face base = find_face(mesh, 0, 1, 2);
  ASSERT_NE(base, kNone);
  const Tet above = mesh.apex(base) == 4 ? tet_of(base) : tet_of(mesh.neighbour(base));
  ASSERT_GE(mesh.index_of(above, 4), 0);
  const Vertex top = MeshEditor(mesh).add_vertex(Point{0.3, 0.3, 1e-12});
  const std::vector<Tet> old_tets{above};
  MeshEditor(mesh).replace({.old_tets = old_tets, .new_tets = cone(outer_faces(mesh, old_tets), top)});
  for (const FaceKey& f : {FaceKey{0, 1, top}, FaceKey{1, 2, top}, FaceKey{2, 0, top}}) {
    MeshEditor(mesh).set_facet(find_face(mesh, f[0], f[1], f[2]));
    for (std::size_t k = 0; k < 3; ++k)
      MeshEditor(mesh).set_segment(find_edge(mesh, f[k], f[(k + 1) % 3]), f[k], f[(k + 1) % 3]);
  }
  const Tet cap = worst_tet(mesh);
  ASSERT_GT(quality_of(mesh, mesh.corners(cap)), 1e10);
  const exact::Dyadic volume = volume_of(mesh);
  std::vector<Tet> created;
  std::vector<Vertex> spare;
  for (int k = 0; k < 2; ++k) spare.push_back(MeshEditor(mesh).add_vertex(Point{}));
  const Vertex p = insert_point(mesh, cap, first_free, 1000, &spare, created);
  EXPECT_EQ(p + 1, mesh.vertex_count());
  EXPECT_EQ(spare, (std::vector{p - 1}));
  EXPECT_LT(badness_of(mesh, created, {kInfinity}).worst, 1000);
  EXPECT_LT(worst_quality(mesh), 1e4);
  EXPECT_EQ(facet_faces(mesh).size(), 3u);
  expect_sound(mesh, volume);
}

// Two grids in parallel planes, so close that every tetrahedron between them is flat, and oblique to the
// axes, so that rounding gives four points of a plane any orientation.
TetMesh slab(double gap) {
  const Point u{0.36, 0.48, 0.8}, v{-0.8, 0.6, 0}, w{-0.48, -0.64, 0.6};
  std::vector<Point> points;
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 7; ++j)
      for (int k = 0; k < 2; ++k) {
        Point p{};
        for (std::size_t c = 0; c < 3; ++c)
          p[c] = 0.7 * (i - 3) * u[c] + 0.7 * (j - 3) * v[c] + k * gap * w[c];
        points.push_back(p);
      }
  return delaunay_in_box(points, 9);
}

TEST(Optimise, NoNullTetrahedraStayInAThinSlab) {
  for (const double gap : {1e-3, 1e-5}) {
    TetMesh mesh = slab(gap);
    const exact::Dyadic volume = volume_of(mesh);
    const BadFrom from{100, 1000, 1e10};
    EXPECT_GT(badness_of(mesh, solid(mesh), from).null, 10u);
    const Options options;
    Monitor monitor(options);
    optimise(mesh, solid(mesh), static_cast<Vertex>(mesh.vertex_count()), 2, 1, monitor);
    const Badness after = badness_of(mesh, solid(mesh), from);
    EXPECT_EQ(after.null, 0u) << gap;
    EXPECT_GT(after.hopeless, 10u) << gap;
    expect_sound(mesh, volume);
  }
}

TEST(Optimise, RemovesSlivers) {
  for (const double jitter : {0.0, 1e-15, 1e-9, 1e-3, 0.3})
    for (const bool constrained : {false, true}) {
      TetMesh mesh = slivers(jitter, 11);
      std::mt19937_64 random(2);
      if (constrained) constrain(mesh, random);
      const auto facets = facet_faces(mesh);
      const auto segments = segment_edges(mesh);
      const exact::Dyadic volume = volume_of(mesh);
      const Badness before = badness_of(mesh, solid(mesh), {100});
      const Options options;
      Monitor monitor(options);
      optimise(mesh, solid(mesh), static_cast<Vertex>(mesh.vertex_count()), 20, 1, monitor);
      const Badness after = badness_of(mesh, solid(mesh), {100});
      EXPECT_FALSE(before < after);
      if (!constrained) {  // facets on both sides of a sliver keep it
        EXPECT_LT(after.worst, 100) << jitter;
      }
      EXPECT_EQ(facet_faces(mesh), facets);
      EXPECT_EQ(segment_edges(mesh), segments);
      expect_sound(mesh, volume);
    }
}

// Flips near an element change others of its region, whose slots the search did not get: these count, too.
TEST(Shake, IsNotAtTheExpenseOfOthers) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    TetMesh mesh = slivers(0.3, seed, 3);
    std::mt19937_64 random(seed);
    constrain(mesh, random);
    const Badness before = badness_of(mesh, solid(mesh), {100, 1000, 1e10});
    const Tet worst = worst_tet(mesh);
    const Options options;
    Monitor monitor(options);
    Search search(mesh, {worst}, static_cast<Vertex>(mesh.vertex_count()), 2, seed, 1, monitor);
    search.agenda().give_up({before.worst, worst, mesh.corners(worst)});
    shake_the_worst(search);
    const Badness after = badness_of(mesh, solid(mesh), {100, 1000, 1e10});
    EXPECT_LE(std::tuple(after.null, after.hopeless, after.worst),
              std::tuple(before.null, before.hopeless, before.worst))
        << seed;
  }
}

// Its corners come first.
TetMesh cube_with_points(std::size_t n, std::uint64_t seed) {
  TetMesh mesh;
  for (unsigned k = 0; k < 8; ++k)
    MeshEditor(mesh).add_vertex(
        Point{(k & 1u) != 0 ? 1.0 : -1.0, (k & 2u) != 0 ? 1.0 : -1.0, (k & 4u) != 0 ? 1.0 : -1.0});
  for (const Point& p : random_points(n, seed)) MeshEditor(mesh).add_vertex(p);
  EXPECT_TRUE(build_delaunay(mesh, {}, nullptr));
  return mesh;
}

// The elements where a point was have exactly the recorded quality.
TEST(RemovePoints, KeepsNoQualityOfRemovedElements) {
  std::size_t removed = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    TetMesh mesh = cube_with_points(20, seed);
    const Options options;
    Monitor monitor(options);
    Search search(mesh, solid(mesh), 8, 2, seed, 1, monitor);
    ASSERT_TRUE(search.worst());
    remove_points(search, 0);
    removed += search.stats().removed;
    const std::optional<WaitingElement> worst = search.worst();
    const double stands = badness_of(mesh, solid(mesh), {100, 1000, 1e10}).worst;
    EXPECT_EQ(worst.has_value(), stands > tuning::kGood) << seed;
    if (worst) {
      EXPECT_EQ(worst->quality, stands) << seed;
    }
  }
  EXPECT_GT(removed, 0u);
}

TEST(Quality, PlainArithmeticAgreesWithTheCarefulOne) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int k = 0; k < 2000; ++k) {
    std::array<Point, 4> p;
    for (Point& q : p) q = {u(random), u(random), u(random) * std::pow(10.0, -(k % 12))};
    std::array<Point, 4> large = p;  // too large for plain arithmetic
    for (Point& q : large)
      for (double& x : q) x = std::ldexp(x, 300);
    const double q = quality(p[0], p[1], p[2], p[3]);
    EXPECT_NEAR(quality(large[0], large[1], large[2], large[3]) / q, 1, 1e-9);
  }
}

}  // namespace
}  // namespace holdfast::optimise_test
