// Random exchanges round the worst element: none makes anything as bad, and a finished walk pays.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

#include "mesh/assembly.h"
#include "mesh/validate.h"
#include "mesh_fixtures.h"
#include "optimise/badness.h"
#include "optimise/forced_apex.h"
#include "optimise/optimise.h"
#include "optimise/qualities.h"
#include "optimise/random_exchange.h"
#include "optimise/search.h"
#include "optimise/walking.h"

namespace holdfast::optimise_walking_test {
namespace {

using namespace testing;

constexpr BadFrom kFrom{100, 1000, 1e10};

TEST(RandomExchange, MakesNothingAsBad) {
  std::mt19937_64 random(7);
  TetMesh mesh = slivers(0.2, 7, 3);
  const exact::Dyadic volume = volume_of(mesh);
  RandomExchanger exchanger(mesh);
  std::vector<Tet> created;
  int made = 0;
  for (int k = 0; k < 2000; ++k) {
    const std::vector<Tet> tets = solid(mesh);
    const Tet t = tets[random() % tets.size()];
    created.clear();
    if (!exchanger.exchange(t, 50, random, created)) continue;
    ++made;
    EXPECT_LT(badness_of(mesh, created, kFrom).worst, 50);
  }
  EXPECT_GT(made, 500);
  EXPECT_EQ(find_fault(mesh), "");
  EXPECT_EQ((volume_of(mesh) - volume).sign(), 0);
}

// Unchanged blocks are not examined again.
TEST(Qualities, TheWorstIsThatOfAScan) {
  std::mt19937_64 random(3);
  TetMesh mesh = slivers(0.3, 3, 8);
  ASSERT_GT(mesh.slot_count(), 1500);  // more than a block
  Qualities qualities(mesh);
  RandomExchanger exchanger(mesh);
  const auto counts = [](Tet t) { return t % 5 != 0; };
  std::vector<Tet> created;
  for (int k = 0; k < 300; ++k) {
    Tet worst = kNone;
    double most = 2;
    const std::vector<Tet> tets = solid(mesh);
    for (const Tet t : tets) {
      const double q = quality_of(mesh, mesh.corners(t));
      if (!counts(t) || !(q > most)) continue;
      most = q;
      worst = t;
    }
    const auto is_solid = [&](Tet t) { return counts(t) && !mesh.is_ghost(t); };
    const Tet found = qualities.worst(
        2, is_solid, [](Tet) { return false; }, 2);
    const Tet next = qualities.worst(
        2, is_solid, [&](Tet t) { return t == found; }, 2);
    ASSERT_EQ(found, worst);
    EXPECT_NE(next, worst);
    created.clear();
    exchanger.exchange(k % 2 == 0 ? worst : tets[random() % tets.size()], 1e10, random, created);
    qualities.forget(created);
  }
}

// A flat tetrahedron on a facet, alone, and many vertices below its plane; or one of them above it, at any
// position among the others.
TEST(ForcedApex, IsFoundWhereverItIsOnAnyNumberOfThreads) {
  constexpr int kOthers = 20'000;
  for (const int good : {-1, 4, 9'000, kOthers - 1}) {
    TetMesh mesh;
    for (const Point& p : {Point{0, 0, 0}, Point{1, 0, 0}, Point{0, 1, 0}, Point{0.3, 0.3, 0.001}})
      MeshEditor(mesh).add_vertex(p);
    for (int k = 4; k < kOthers; ++k) MeshEditor(mesh).add_vertex(Point{0.3, 0.3, k == good ? 0.8 : -0.8});
    const TetMesh::Corners inside{0, 1, 2, 3};
    MeshAssembly assembly(mesh);
    const Tet t = assembly.add_tet(inside);
    for (int side = 0; side < 4; ++side) {
      const auto v = corners_of_face(inside, side);
      const Tet ghost = assembly.add_tet({v[0], v[2], v[1], kGhost});
      assembly.link(face_code(t, side), face_code(ghost, 3));
    }
    assembly.set_flags(t, facet_bit(3));
    const WaitingElement flat{quality_of(mesh, inside), t, inside};
    ASSERT_GT(flat.quality, 100);
    for (const unsigned threads : {1u, 2u, 4u})
      EXPECT_EQ(may_be_better(mesh, flat, threads), good > 0) << good;
  }
}

// A walk may remove an element that neither exchanges nor shakes remove; the result is no worse.
TEST(Walk, HelpsIfNothingElseDoes) {
  int better = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    TetMesh mesh = slivers(0.4, seed, 3);
    const exact::Dyadic volume = volume_of(mesh);
    const Options options;
    Monitor monitor(options);
    const auto first_free = static_cast<Vertex>(mesh.vertex_count());
    const std::vector<Tet> tets = solid(mesh);
    Search search(mesh, tets, first_free, 2, seed, 1, monitor);
    search.push_all(tets);
    search.work_off(Ways::Points::none);
    const Badness before = badness_of(mesh, solid(mesh), kFrom);
    walk_from_the_worst(search);
    const Badness after = badness_of(mesh, solid(mesh), kFrom);
    EXPECT_LE(std::tuple(after.null, after.hopeless, after.worst),
              std::tuple(before.null, before.hopeless, before.worst))
        << seed;
    if (after.worst < before.worst) ++better;
    EXPECT_EQ(find_fault(mesh), "");
    EXPECT_EQ((volume_of(mesh) - volume).sign(), 0);
  }
  EXPECT_GT(better, 0);
}

}  // namespace
}  // namespace holdfast::optimise_walking_test
