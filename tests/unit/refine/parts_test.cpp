// A mesh cut into parts and joined again.
#include "refine/parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <stdexcept>

#include "delaunay/delaunay.h"
#include "mesh/editor.h"
#include "mesh/measure.h"
#include "mesh/traverse.h"
#include "mesh/validate.h"
#include "mesh_fixtures.h"
#include "numbers/vector.h"
#include "optimise/energy.h"
#include "optimise/improve_parts.h"
#include "optimise/volume.h"
#include "refine/cut_parts.h"
#include "refine/point_cavity.h"

namespace holdfast::parts_test {
namespace {

using testing::corners_of_unit_cube;
using testing::point_in_unit_cube;

/// The Delaunay triangulation of a cube and random points in it; with a wall, two regions and facets between
/// them.
struct Cube {
  TetMesh mesh;
  std::vector<RegionId> region_of;
  std::vector<double> sizes;
  const std::vector<bool> kept{true, true};
  Vertex first_free = 8;

  explicit Cube(int points, bool with_wall) {
    std::mt19937_64 random(7);
    for (const Point& p : corners_of_unit_cube()) MeshEditor(mesh).add_vertex(p);
    for (int k = 0; k < points; ++k) MeshEditor(mesh).add_vertex(point_in_unit_cube(random));
    EXPECT_TRUE(build_delaunay(mesh, {1}, nullptr));
    sizes.assign(mesh.vertex_count(), 0.1);
    region_of.assign(mesh.slot_count(), 0);
    if (with_wall) build_wall();
  }

  void build_wall() {
    first_free = static_cast<Vertex>(mesh.vertex_count());
    for (Tet t = 0; t < mesh.slot_count(); ++t)
      if (!mesh.is_ghost(t) && centroid(mesh, t)[1] > 0.5) region_of[t] = 1;
    for (Tet t = 0; t < mesh.slot_count(); ++t)
      for (int i = 0; i < 4; ++i) {
        const Face f = face_code(t, i);
        const Tet n = tet_of(mesh.neighbour(f));
        if (mesh.is_ghost(t) || mesh.is_ghost(n) || region_of[t] >= region_of[n]) continue;
        MeshEditor(mesh).set_facet(f);
        const auto v = mesh.face_vertices(f);
        for (std::size_t k = 0; k < 3; ++k) MeshEditor(mesh).set_segment(t, v[k], v[(k + 1) % 3]);
      }
    EXPECT_EQ(find_fault(mesh), "");
  }

  [[nodiscard]] VolumeData data() { return {mesh, region_of, sizes, kept, first_free}; }
  /// By slot: the part in a pattern of bricks; every eleventh slot is in no part.
  [[nodiscard]] std::vector<std::uint32_t> bricks() const {
    std::vector<std::uint32_t> part_of(mesh.slot_count(), kNone);
    for (Tet t = 0; t < mesh.slot_count(); ++t)
      if (!mesh.is_ghost(t) && t % 11 != 0)
        part_of[t] = (centroid(mesh, t)[0] < 0.6 ? 0 : 1) + (centroid(mesh, t)[2] < 0.4 ? 0 : 2);
    return part_of;
  }
  /// With constraints: corners in ascending order, and the facets and segments among them.
  [[nodiscard]] std::map<TetMesh::Corners, std::vector<std::uint32_t>> content() const {
    std::map<TetMesh::Corners, std::vector<std::uint32_t>> all;
    for (Tet t = 0; t < mesh.slot_count(); ++t) {
      if (!mesh.alive(t)) continue;
      TetMesh::Corners key = mesh.corners(t);
      std::sort(key.begin(), key.end());
      auto& what = all[key];
      what.push_back(region_of[t]);
      for (int i = 0; i < 4; ++i)
        if (mesh.is_facet(face_code(t, i))) what.push_back(mesh.corner(t, i));
      for (int k = 0; k < 6; ++k)
        if (mesh.is_segment(t, k))
          for (const int end : kEdgeVertex[static_cast<std::size_t>(k)]) what.push_back(mesh.corner(t, end));
      std::sort(what.begin() + 1, what.end());
    }
    return all;
  }
};

TEST(Parts, AreValidMeshesAndJoinToTheOriginal) {
  for (const bool with_wall : {false, true}) {
    Cube cube(3000, with_wall);
    const auto before = cube.content();
    const VolumeData whole = cube.data();
    Parts parts(whole, cube.bricks(), 4, 2);
    for (const Part& part : parts.parts()) {
      EXPECT_EQ(find_fault(part.mesh), "");
      EXPECT_GT(part.first_free, 0u);
      EXPECT_EQ(part.first_free < part.mesh.vertex_count(), !with_wall);
    }
    parts.join(2);
    EXPECT_EQ(find_fault(cube.mesh), "");
    EXPECT_EQ(cube.content(), before);
  }
}

TEST(Parts, EdgesOfInterfacesAreSegmentsAndTheirFacesFacets) {
  Cube cube(2000, true);
  const VolumeData whole = cube.data();
  Parts parts(whole, cube.bricks(), 4, 1);
  std::size_t interfaces = 0;
  for (const Part& part : parts.parts())
    for (Tet t = 0; t < part.mesh.slot_count(); ++t) {
      if (!part.is_beyond_interface(t)) continue;
      ++interfaces;
      EXPECT_TRUE(part.mesh.is_facet(face_code(t, 3)));
      for (const int edge : {0, 1, 3}) EXPECT_TRUE(part.mesh.is_segment(t, edge));
      for (const Vertex v : part.mesh.face_vertices(face_code(t, 3))) {
        EXPECT_LT(v, part.first_free);
        EXPECT_TRUE(part.on_cut()[v] == 1 || !part.is_beyond_cut(t));
      }
    }
  EXPECT_GT(interfaces, 1000u);
}

// Points are inserted in each part, and some slots and vertices are added and removed.
TEST(Parts, JoinToAValidMeshAfterChanges) {
  Cube cube(2000, true);
  const auto facets = [&] {
    std::size_t count = 0;
    for (Tet t = 0; t < cube.mesh.slot_count(); ++t)
      for (int i = 0; i < 4; ++i) count += cube.mesh.alive(t) && cube.mesh.is_facet(face_code(t, i));
    return count;
  };
  const std::size_t facets_before = facets(), vertices_before = cube.mesh.vertex_count();
  const VolumeData whole = cube.data();
  Parts parts(whole, cube.bricks(), 4, 1);
  std::mt19937_64 random(3);
  std::size_t inserted = 0;
  for (Part& part : parts.parts()) {
    PointCavity cavity(part.mesh);
    for (int k = 0; k < 300; ++k) {
      const auto base = static_cast<Tet>(random() % part.mesh.slot_count());
      if (!part.mesh.alive(base) || part.mesh.is_ghost(base)) continue;
      const Vertex p = MeshEditor(part.mesh).add_vertex(centroid(part.mesh, base));
      if (cavity.locate(p, base) != base || !cavity.find(p, base, {})) {
        MeshEditor(part.mesh).remove_last_vertex();
        continue;
      }
      const RegionId region = part.region_of[base];
      cavity.insert();
      part.sizes.push_back(0.5);
      part.region_of.resize(part.mesh.slot_count());
      for (const Tet t : cavity.created()) part.region_of[t] = region;
      ++inserted;
    }
    EXPECT_EQ(find_fault(part.mesh), "");
  }
  ASSERT_GT(inserted, 200u);
  for (Part& part : parts.parts()) part.order_along_curve();
  for (const Part& part : parts.parts()) EXPECT_EQ(find_fault(part.mesh), "");
  parts.join(1);
  EXPECT_EQ(find_fault(cube.mesh), "");
  EXPECT_EQ(cube.mesh.vertex_count(), vertices_before + inserted);
  EXPECT_EQ(facets(), facets_before);
  for (Vertex v = 0; v < cube.mesh.vertex_count(); ++v)
    EXPECT_EQ(cube.sizes[v], v < vertices_before ? 0.1 : 0.5);
  for (Tet t = 0; t < cube.mesh.slot_count(); ++t)
    for (int i = 0; i < 4; ++i) {
      const Tet n = tet_of(cube.mesh.neighbour(t, i));
      if (cube.mesh.is_ghost(t) || cube.mesh.is_ghost(n) || cube.mesh.is_facet(face_code(t, i))) continue;
      EXPECT_EQ(cube.region_of[t], cube.region_of[n]);
    }
}

// A thin layer of points between two distant ones: nearly every tetrahedron is near each cut, every time.
TEST(Parts, CuttingAgainEnds) {
  std::mt19937_64 random(7);
  TetMesh mesh;
  MeshEditor(mesh).add_vertex(Point{0.5, 0.5, 1});
  MeshEditor(mesh).add_vertex(Point{0.5, 0.5, -1});
  for (int k = 0; k < 15000; ++k) {
    const Point p = point_in_unit_cube(random);
    MeshEditor(mesh).add_vertex(Point{p[0], p[1], 0.01 * p[2]});
  }
  ASSERT_TRUE(build_delaunay(mesh, {1}, nullptr));
  std::vector<RegionId> region_of(mesh.slot_count(), 0);
  std::vector<double> sizes(mesh.vertex_count(), 0.1);
  const std::vector<bool> kept{true};
  std::unique_ptr<Parts> parts =
      cut_evenly({mesh, region_of, sizes, kept, static_cast<Vertex>(mesh.vertex_count())}, 1);
  ASSERT_TRUE(parts);
  for (int rounds = 0; parts; ++rounds) {
    ASSERT_LT(rounds, 10);
    parts = join_and_cut_again(*parts, 1);
  }
  EXPECT_EQ(find_fault(mesh), "");
}

// So that one thread does not do the last work alone: the rest is small compared with the mesh, but worth two
// parts.
TEST(Parts, TheRestIsCutAgainIfItIsMuchOfTheMesh) {
  Cube cube(25000, false);
  std::unique_ptr<Parts> parts = cut_evenly(cube.data(), 1);
  ASSERT_TRUE(parts);
  ASSERT_GT(parts->parts().size(), 1u);
  parts = join_and_cut_again(*parts, 1);
  ASSERT_TRUE(parts);
  EXPECT_LT(parts->tet_count(), 60'000u);
  EXPECT_GT(parts->tet_count(), cube.mesh.tet_count() / 12);
  EXPECT_GT(parts->parts().size(), 1u);
  while (parts) parts = join_and_cut_again(*parts, 1);
  EXPECT_EQ(find_fault(cube.mesh), "");
}

TEST(Parts, KnowWhichVerticesWereOnCutsBefore) {
  Cube cube(14000, false);
  std::unique_ptr<Parts> parts = cut_evenly(cube.data(), 2);
  ASSERT_TRUE(parts);
  for (const Part& part : parts->parts()) EXPECT_TRUE(part.was_on_cut().empty());
  const std::vector<Vertex> between = parts->vertices_between();
  std::set<Point> places;
  for (const Vertex v : between) places.insert(cube.mesh.position(v));
  parts = join_and_cut_again(*parts, 2);
  ASSERT_TRUE(parts);
  std::set<Point> told;
  for (const Part& part : parts->parts()) {
    ASSERT_EQ(part.was_on_cut().size(), part.mesh.vertex_count());
    for (Vertex v = 0; v < part.mesh.vertex_count(); ++v)
      if (part.was_on_cut()[v] != 0) told.insert(part.mesh.position(v));
  }
  EXPECT_EQ(told, places);
  EXPECT_LT(told.size(), parts->parts().front().mesh.vertex_count());
}

TEST(ImprovedVolume, CountsElementsAtFreshVerticesAsChanged) {
  Cube cube(2000, false);
  std::vector<std::uint8_t> fresh(cube.mesh.vertex_count(), 0);
  fresh[100] = 1;
  fresh.pop_back();  // the last vertex has a higher number than the list
  ImprovedVolume volume(cube.data(), fresh);
  ImprovedVolume all(cube.data());
  const auto last = static_cast<Vertex>(fresh.size());
  for (Tet t = 0; t < cube.mesh.slot_count(); ++t) {
    if (!cube.data().is_inside(t)) continue;
    EXPECT_EQ(volume.energy(t), volume.energy_of(cube.mesh.corners(t)));
    EXPECT_TRUE(all.take_changed(t));
    const bool is_at_one = cube.mesh.index_of(t, 100) >= 0 || cube.mesh.index_of(t, last) >= 0;
    EXPECT_EQ(volume.take_changed(t), is_at_one);
    EXPECT_FALSE(volume.take_changed(t));
  }
  for (Vertex v = 0; v <= last; ++v) EXPECT_EQ(volume.take_touched(v), v == 100 || v == last);
}

// The CPU time of a thread, however little of the processor it gets.
double seconds_of_this_thread() {
  timespec used{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

TEST(TasksInParts, AnErrorInOneIsPassedOnAndInterruptsTheOthers) {
  Options options;
  Monitor monitor(options);
  EXPECT_THROW(parallel_monitored(2, 4, monitor, {0, 1},
                                  [](std::size_t k, Monitor&) {
                                    if (k == 2) throw std::runtime_error("broken");
                                  }),
               std::runtime_error);
  options.progress = [](const Progress&) { return false; };
  const auto poll_for_long = [](std::size_t, Monitor& own) {
    const double end = seconds_of_this_thread() + 20;
    while (seconds_of_this_thread() < end) own.poll(Stage::optimise, 0);
    ADD_FAILURE() << "nobody told";
  };
  EXPECT_THROW(parallel_monitored(3, 6, monitor, {0, 1}, poll_for_long), Interrupted);
  // As Ctrl-C in Python: thrown once by the caller's function. On one thread the other tasks have not begun.
  for (const unsigned threads : {1u, 3u}) {
    bool thrown = false;
    options.progress = [&](const Progress&) {
      if (!std::exchange(thrown, true)) throw std::runtime_error("of the caller");
      return true;
    };
    EXPECT_THROW(parallel_monitored(threads, 6, monitor, {0, 1}, poll_for_long), std::runtime_error);
  }
}

TEST(ImproveInParts, IsTheSameOnAnyNumberOfThreadsAndMissesNothing) {
  const auto improved = [](unsigned threads) {
    Cube cube(14000, false);  // some 90,000 tetrahedra: two parts
    const Options options;
    Monitor monitor(options);
    improve_in_parts(cube.data(), {}, Effort::fast, threads, monitor);
    EXPECT_EQ(find_fault(cube.mesh), "");
    return cube;
  };
  const Cube one = improved(1), two = improved(2);
  EXPECT_EQ(one.content(), two.content());
  EXPECT_TRUE(std::ranges::equal(one.mesh.positions(), two.mesh.positions()));

  // As good near the cut as elsewhere.
  const auto bad_share = [&](bool near) {
    double bad = 0, all = 0;
    for (Tet t = 0; t < one.mesh.slot_count(); ++t) {
      if (!one.mesh.alive(t) || one.mesh.is_ghost(t)) continue;
      const Point c = centroid(one.mesh, t);
      bool near_middle = false;
      for (const double x : c) near_middle = near_middle || std::abs(x - 0.5) < 0.02;
      if (near_middle != near) continue;
      const auto& v = one.mesh.corners(t);
      all += 1;
      bad += energy(one.mesh.position(v[0]), one.mesh.position(v[1]), one.mesh.position(v[2]),
                    one.mesh.position(v[3])) > energy_of_sine(0.17);
    }
    return bad / all;
  };
  EXPECT_LT(bad_share(true), 1.5 * bad_share(false) + 0.002);
}

TEST(ImproveInParts, MoreEffortKeepsTheFiguresOfTheWholeOnAnyNumberOfThreads) {
  const Options options;
  Monitor monitor(options);
  Cube fast(14000, false);  // some 90,000 tetrahedra: two parts
  improve_in_parts(fast.data(), {}, Effort::fast, 2, monitor);
  const Figures before = figures_of(fast.data());
  const auto improved = [&](unsigned threads) {
    Cube cube = fast;
    improve_further_in_parts(cube.data(), Effort::good, std::nullopt, {0, 1}, threads, monitor);
    EXPECT_EQ(find_fault(cube.mesh), "");
    return cube;
  };
  Cube one = improved(1);
  const Cube two = improved(2);
  EXPECT_EQ(one.content(), two.content());
  EXPECT_TRUE(std::ranges::equal(one.mesh.positions(), two.mesh.positions()));
  const Figures after = figures_of(one.data());
  EXPECT_TRUE(after.is_no_worse_than(before));
  EXPECT_LT(after.below_10_deg(), before.below_10_deg());
}

}  // namespace
}  // namespace holdfast::parts_test
