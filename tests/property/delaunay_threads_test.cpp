// The same mesh, bit for bit, for any number of threads and any order of insertion.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "delaunay/delaunay.h"
#include "delaunay/insert.h"
#include "delaunay/number.h"
#include "delaunay_checks.h"

namespace holdfast::delaunay_threads_test {
namespace {

using Random = std::mt19937_64;
using testing::delaunay_fault;
using testing::mesh_of;

double integer(Random& random, int low, int high) {
  return static_cast<double>(std::uniform_int_distribution<int>(low, high)(random));
}
double unit(Random& random) { return std::uniform_real_distribution<double>(0, 1)(random); }

struct Family {
  const char* name;
  std::function<Point(Random&)> point;
};

const std::vector<Family>& families() {
  static const std::vector<Family> all = {
      {"random",
       [](Random& r) {
         return Point{unit(r), unit(r), unit(r)};
       }},
      {"cospherical grid",
       [](Random& r) {
         return Point{integer(r, 0, 29), integer(r, 0, 29), integer(r, 0, 29)};
       }},
      {"coplanar but for a few",
       [](Random& r) {
         return Point{integer(r, 0, 120), integer(r, 0, 120), unit(r) < 0.001 ? 1.0 : 0.0};
       }},
      {"many duplicates",
       [](Random& r) {
         return Point{integer(r, 0, 11), integer(r, 0, 11), integer(r, 0, 11)};
       }},
      {"duplicates in a cube",
       [](Random& r) {
         Random same(static_cast<std::uint64_t>(integer(r, 0, 5000)));
         return Point{unit(same), unit(same), unit(same)};
       }},
      {"sphere",
       [](Random& r) {
         for (;;) {
           const double x = 2 * unit(r) - 1, y = 2 * unit(r) - 1, s = x * x + y * y;
           if (s >= 1) continue;
           const double c = 2 * std::sqrt(1 - s);
           return Point{c * x, c * y, 1 - 2 * s};
         }
       }},
      {"one line and a cloud",
       [](Random& r) {
         return unit(r) < 0.5 ? Point{0, 0, integer(r, 0, 5000)}
                              : Point{1 + unit(r), unit(r), 5000 * unit(r)};
       }},
      {"three parallel planes",
       [](Random& r) {
         return Point{integer(r, 0, 2), integer(r, 0, 60), integer(r, 0, 60)};
       }},
  };
  return all;
}

// Enough for rounds on several threads; the thread sanitizer takes fifty times as long.
#ifdef __SANITIZE_THREAD__
constexpr std::size_t kMany = 18000;
#else
constexpr std::size_t kMany = 60000;
#endif

std::vector<Point> sample(const Family& family, std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Point> points(n);
  for (Point& p : points) p = family.point(random);
  return points;
}

TetMesh triangulated(const std::vector<Point>& points, unsigned threads) {
  TetMesh mesh = mesh_of(points);
  EXPECT_TRUE(build_delaunay(mesh, {7, threads}, nullptr));
  return mesh;
}

void expect_same(const TetMesh& a, const TetMesh& b, const std::string& what) {
  ASSERT_EQ(a.slot_count(), b.slot_count()) << what;
  for (Tet t = 0; t < a.slot_count(); ++t) {
    ASSERT_EQ(a.corners(t), b.corners(t)) << what << ", tetrahedron " << t;
    for (int i = 0; i < 4; ++i)
      ASSERT_EQ(a.neighbour(t, i), b.neighbour(t, i)) << what << ", tetrahedron " << t;
  }
  for (Vertex v = 0; v < a.vertex_count(); ++v) ASSERT_EQ(a.incident(v), b.incident(v)) << what;
}

TEST(DelaunayThreads, AnyNumberGivesTheSameMesh) {
  for (const Family& family : families()) {
    const std::vector<Point> points = sample(family, kMany, 11);
    const TetMesh one = triangulated(points, 1);
    ASSERT_EQ(delaunay_fault(one), "") << family.name;
    for (const unsigned threads : {2u, 3u, 4u})
      expect_same(one, triangulated(points, threads),
                  family.name + std::string(", threads: ") + std::to_string(threads));
  }
}

TEST(DelaunayThreads, TheFunctionOfTheLibraryToo) {
  for (const Family& family : families()) {
    const std::vector<Point> points = sample(family, kMany, 12);
    const std::vector<Tetrahedron> one = delaunay(points, 3, 1);
    for (const unsigned threads : {0u, 2u, 4u}) ASSERT_EQ(one, delaunay(points, 3, threads)) << family.name;
    // The mesh without its ghosts.
    TetMesh mesh = mesh_of(points);
    ASSERT_TRUE(build_delaunay(mesh, {3, 1}, nullptr));
    std::vector<Tetrahedron> finite;
    for (Tet t = 0; t < mesh.slot_count(); ++t)
      if (!mesh.is_ghost(t)) finite.push_back(mesh.corners(t));
    ASSERT_EQ(one, finite) << family.name;
  }
}

// The reason: the numbering of the vertices decides, not the order of their insertion.
TEST(DelaunayThreads, AnyOrderOfInsertionGivesTheSameTriangulation) {
  Random random(5);
  for (const Family& family : families()) {
    std::vector<Point> points = sample(family, 400, random());
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    std::shuffle(points.begin(), points.end(), random);
    std::vector<std::uint32_t> numbers(points.size());
    std::iota(numbers.begin(), numbers.end(), 0u);
    std::vector<TetMesh::Cell> first;
    for (int round = 0; round < 6; ++round) {
      Triangulation triangulation(points, {numbers, {numbers.size()}}, 1);
      if (!triangulation.start()) break;
      std::vector<Vertex> order(triangulation.size() - 4);
      std::iota(order.begin(), order.end(), 4u);
      if (round > 0) std::shuffle(order.begin(), order.end(), random);
      Inserter inserter(triangulation, 0, random());
      for (const Vertex k : order) round == 0 ? inserter.insert(k) : inserter.insert_late(k);
      inserter.give_slots_back();
      std::vector<TetMesh::Cell> cells = all_cells(triangulation, 1);
      if (round == 0)
        first = std::move(cells);
      else
        ASSERT_TRUE(first == cells) << family.name;
    }
  }
}

}  // namespace
}  // namespace holdfast::delaunay_threads_test
