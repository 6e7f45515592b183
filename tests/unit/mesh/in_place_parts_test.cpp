// Parts of one mesh, changed at the same time: each only changes itself, and threads make no difference.
#include "mesh/in_place_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "mesh/parallel.h"
#include "mesh/validate.h"
#include "mesh_fixtures.h"
#include "optimise/optimise.h"
#include "optimise/random_exchange.h"
#include "optimise/search.h"
#include "optimise/search_in_parts.h"

namespace holdfast::in_place_parts_test {
namespace {

using namespace testing;

std::vector<InPlaceParts::PartNumber> slabs(const TetMesh& mesh, int count, double width) {
  std::vector<InPlaceParts::PartNumber> part_of;
  for (const Point& p : mesh.positions())
    part_of.push_back(
        static_cast<InPlaceParts::PartNumber>(std::clamp(static_cast<int>(p[0] / width), 0, count - 1)));
  return part_of;
}

// Random exchanges in each part.
void exchange_apart(TetMesh& mesh, unsigned threads) {
  const std::vector<Tet> tets = solid(mesh);
  const auto part_of = slabs(mesh, 3, 3);
  const InPlaceParts parts(mesh, tets, part_of, 3, 200, threads);
  parallel(threads, 3, [&](std::size_t k) {
    std::mt19937_64 random(k);
    RandomExchanger exchanger(mesh);
    std::vector<Tet> own, created;
    for (const Tet t : tets)
      if (parts.part_of(t) == k) own.push_back(t);
    for (int step = 0; step < 2000 && parts.spare(k) > 20; ++step) {
      const Tet t = own[random() % own.size()];
      if (!mesh.alive(t)) continue;
      created.clear();
      exchanger.exchange(t, 1e3, random, created);
      for (const Tet fresh : created) EXPECT_EQ(parts.part_of(fresh), k);
      own.insert(own.end(), created.begin(), created.end());
    }
  });
}

TEST(InPlaceParts, KeepToThemselves) {
  TetMesh mesh = slivers(0.3, 5, 9);
  const TetMesh before = mesh;
  const exact::Dyadic volume = volume_of(mesh);
  std::vector<Tet> mixed;
  {
    const InPlaceParts parts(mesh, solid(mesh), slabs(mesh, 3, 3), 3, 10, 1);
    mixed = parts.mixed();
    ASSERT_FALSE(mixed.empty());
    EXPECT_EQ(find_fault(mesh), "");  // what is held is so from all sides
    for (std::size_t k = 0; k < 3; ++k) EXPECT_GE(parts.spare(k), 10);
  }
  EXPECT_EQ(mesh.slot_count(), before.slot_count());
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    EXPECT_EQ(mesh.corners(t), before.corners(t));
    EXPECT_EQ(mesh.flags(t), before.flags(t));
  }
  exchange_apart(mesh, 2);
  EXPECT_EQ(find_fault(mesh), "");
  EXPECT_EQ((volume_of(mesh) - volume).sign(), 0);
  std::size_t changed = 0;
  for (Tet t = 0; t < before.slot_count(); ++t) {
    EXPECT_TRUE(!mesh.alive(t) || mesh.flags(t) == before.flags(t));
    if (!mesh.alive(t) || mesh.corners(t) != before.corners(t)) ++changed;
  }
  EXPECT_GT(changed, 100);
  for (const Tet t : mixed) EXPECT_EQ(mesh.corners(t), before.corners(t));
}

TEST(InPlaceParts, AreTheSameOnAnyNumberOfThreads) {
  TetMesh one = slivers(0.3, 5, 9), three = one;
  exchange_apart(one, 1);
  exchange_apart(three, 3);
  ASSERT_EQ(one.slot_count(), three.slot_count());
  for (Tet t = 0; t < one.slot_count(); ++t) {
    ASSERT_EQ(one.alive(t), three.alive(t));
    if (!one.alive(t)) continue;
    EXPECT_EQ(one.corners(t), three.corners(t));
    EXPECT_EQ(one.neighbours(t), three.neighbours(t));
  }
}

TEST(InPlaceParts, ConstraintsThatWereThereStay) {
  TetMesh mesh = slivers(0.2, 2, 6);
  const std::vector<Tet> tets = solid(mesh);
  std::mt19937_64 random(1);
  for (int k = 0; k < 200; ++k) {
    const Tet t = tets[random() % tets.size()];
    const auto [a, b] = ends_of_edge(mesh.corners(t), static_cast<int>(random() % 6));
    MeshEditor(mesh).set_segment(t, a, b);
  }
  const TetMesh before = mesh;
  { const InPlaceParts parts(mesh, tets, slabs(mesh, 3, 2), 3, 10, 1); }
  for (Tet t = 0; t < mesh.slot_count(); ++t) EXPECT_EQ(mesh.flags(t), before.flags(t));
}

// The search of a mesh large enough for parts.
TetMesh optimised(TetMesh mesh, unsigned threads) {
  const Options options;
  Monitor monitor(options);
  const auto first_free = static_cast<Vertex>(mesh.vertex_count());
  optimise(mesh, solid(mesh), first_free, 2, threads, monitor, {.add_points = false});
  return mesh;
}

TEST(SearchInParts, LeavesAsLittleOnAnyNumberOfThreads) {
  constexpr BadFrom kFrom{100, 1000, 1e10};
  TetMesh mesh = slivers(0.4, 1, 23);
  ASSERT_GT(solid(mesh).size(), 65'000);
  const Badness before = badness_of(mesh, solid(mesh), kFrom);
  const TetMesh one = optimised(mesh, 1), two = optimised(mesh, 2);
  const Badness after = badness_of(one, solid(one), kFrom);
  EXPECT_LT(after.flat, before.flat / 15);
  EXPECT_EQ(find_fault(one), "");
  EXPECT_EQ((volume_of(one) - volume_of(mesh)).sign(), 0);
  ASSERT_EQ(one.slot_count(), two.slot_count());
  for (Tet t = 0; t < one.slot_count(); ++t) {
    ASSERT_EQ(one.alive(t), two.alive(t));
    EXPECT_TRUE(!one.alive(t) || one.corners(t) == two.corners(t));
  }

  // As little as without parts.
  const Options options;
  Monitor monitor(options);
  Search search(mesh, solid(mesh), static_cast<Vertex>(mesh.vertex_count()), 2, 1, 1, monitor);
  search.push_all(solid(mesh));
  search.work_off(Ways::Points::none);
  EXPECT_LE(after.flat, badness_of(mesh, solid(mesh), kFrom).flat * 11 / 10 + 2);
}

}  // namespace
}  // namespace holdfast::in_place_parts_test
