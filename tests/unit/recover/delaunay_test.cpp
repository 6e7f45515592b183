#include "delaunay/delaunay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "delaunay_checks.h"

namespace holdfast::delaunay_test {
namespace {

using testing::delaunay_fault;
using testing::mesh_of;

std::size_t ghost_count(const TetMesh& mesh) {
  std::size_t n = 0;
  for (Tet t = 0; t < mesh.slot_count(); ++t) n += mesh.alive(t) && mesh.is_ghost(t) ? 1 : 0;
  return n;
}

std::vector<Point> integer_grid(int nx, int ny, int nz) {
  std::vector<Point> points;
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y)
      for (int z = 0; z < nz; ++z)
        points.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
  return points;
}

std::vector<Point> random_cube(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(0, 1);
  std::vector<Point> points(n);
  for (Point& p : points)
    for (double& x : p) x = coordinate(random);
  return points;
}

void expect_delaunay(const std::vector<Point>& points) {
  TetMesh mesh = mesh_of(points);
  ASSERT_TRUE(build_delaunay(mesh, {}, nullptr));
  EXPECT_EQ(delaunay_fault(mesh), "");
}

void expect_flat(const std::vector<Point>& points) {
  TetMesh mesh = mesh_of(points);
  EXPECT_FALSE(build_delaunay(mesh, {}, nullptr));
  EXPECT_EQ(mesh.tet_count(), 0u);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) EXPECT_FALSE(mesh.in_mesh(v));
}

TEST(Delaunay, OneTetrahedron) {
  for (const bool mirrored : {false, true}) {
    const double s = mirrored ? -1 : 1;
    TetMesh mesh = mesh_of(std::vector<Point>{{0, 0, 0}, {s, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    ASSERT_TRUE(build_delaunay(mesh, {}, nullptr));
    EXPECT_EQ(delaunay_fault(mesh), "");
    EXPECT_EQ(mesh.tet_count(), 5u);
    EXPECT_EQ(ghost_count(mesh), 4u);
  }
}

TEST(Delaunay, PointInsideATetrahedron) {
  const auto tets = delaunay(std::vector<Point>{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {1, 1, 1}});
  EXPECT_EQ(tets.size(), 4u);
}

TEST(Delaunay, PrefersTheEmptySpheres) {
  // A flat bipyramid: the long axis must not be an edge, so two tetrahedra and not three.
  EXPECT_EQ(delaunay(std::vector<Point>{{9, 0, 0}, {-5, 8, 0}, {-5, -8, 0}, {0, 0, 3}, {0, 0, -3}}).size(),
            3u);
  EXPECT_EQ(delaunay(std::vector<Point>{{2, 0, 0}, {-1, 2, 0}, {-1, -2, 0}, {0, 0, 9}, {0, 0, -9}}).size(),
            2u);
}

TEST(Delaunay, FewerThanFourOrFlatGivesNothing) {
  expect_flat({});
  expect_flat({{1, 2, 3}});
  expect_flat({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}});
  expect_flat({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {-7, -7, -7}});
  expect_flat(integer_grid(20, 20, 1));
  expect_flat(integer_grid(1, 400, 1));
}

TEST(Delaunay, FlatInAnyPlaneGivesNothing) {
  std::vector<Point> points;
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 30; ++j) points.push_back({0.1 * i, 0.3 * j, 0.1 * i});  // x == z, bit for bit
  expect_flat(points);
}

TEST(Delaunay, IntegerGridHasNoFlatTetrahedron) {
  const auto points = integer_grid(12, 11, 10);
  TetMesh mesh = mesh_of(points);
  ASSERT_TRUE(build_delaunay(mesh, {}, nullptr));
  EXPECT_EQ(delaunay_fault(mesh), "");
  EXPECT_EQ(ghost_count(mesh), 4u * (11 * 10 + 11 * 9 + 10 * 9));
  double six_volumes = 0;
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    if (mesh.is_ghost(t)) continue;
    const auto& c = mesh.corners(t);
    const Point &a = mesh.position(c[0]), &b = mesh.position(c[1]), &d = mesh.position(c[2]),
                &e = mesh.position(c[3]);
    const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double v[3] = {d[0] - a[0], d[1] - a[1], d[2] - a[2]};
    const double w[3] = {e[0] - a[0], e[1] - a[1], e[2] - a[2]};
    six_volumes += u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
                   u[2] * (v[0] * w[1] - v[1] * w[0]);
  }
  EXPECT_EQ(six_volumes, 6.0 * 11 * 10 * 9);
}

TEST(Delaunay, OnePointOffAPlaneGrid) {
  auto points = integer_grid(20, 20, 1);
  points.push_back({7.5, 3.25, 1});
  TetMesh mesh = mesh_of(points);
  ASSERT_TRUE(build_delaunay(mesh, {}, nullptr));
  EXPECT_EQ(delaunay_fault(mesh), "");
  EXPECT_EQ(mesh.tet_count() - ghost_count(mesh), 2u * 19 * 19);
}

TEST(Delaunay, DuplicatesAreLeftOutAndTheFirstStays) {
  auto points = random_cube(300, 5);
  std::vector<Point> all;
  for (int copy = 0; copy < 7; ++copy) all.insert(all.end(), points.begin(), points.end());
  TetMesh mesh = mesh_of(all);
  ASSERT_TRUE(build_delaunay(mesh, {}, nullptr));
  EXPECT_EQ(delaunay_fault(mesh), "");
  for (Vertex v = 0; v < all.size(); ++v) EXPECT_EQ(mesh.in_mesh(v), v < 300);
}

TEST(Delaunay, NegativeZeroIsZero) {
  auto points = integer_grid(3, 3, 3);
  for (const Point& p : integer_grid(3, 3, 3)) {
    Point q = p;
    for (double& x : q)
      if (x == 0) x = -0.0;
    points.push_back(q);
  }
  expect_delaunay(points);
}

TEST(Delaunay, ExtremeCoordinates) {
  for (const double scale : {1e300, 1.7e308, 1e-300, 4.9e-324, 1e-160, 1e160, 0x1p-110, 0x1p110}) {
    std::vector<Point> points = integer_grid(5, 4, 3);
    for (Point& p : points)
      for (double& x : p) x = scale > 1 ? (x - 2) / 4 * scale : x * scale;
    expect_delaunay(points);
  }
  std::vector<Point> mixed;
  const double values[] = {-1.7e308, -1e10, -1e-300, 0, 4.9e-324, 1, 1.6e308};
  for (const double x : values)
    for (const double y : values)
      for (const double z : values) mixed.push_back({x, y, z});
  expect_delaunay(mixed);
}

TEST(Delaunay, DeterminedByPointsAndSeed) {
  const auto points = integer_grid(8, 8, 8);
  EXPECT_EQ(delaunay(points, 3), delaunay(points, 3));
  EXPECT_NE(delaunay(points, 3), delaunay(points, 4));  // cospherical: the diagonals differ
}

TEST(Delaunay, SameTetrahedraForEverySeedInGeneralPosition) {
  const auto points = random_cube(2000, 9);
  const auto canonical = [&](std::uint64_t seed) {
    auto tets = delaunay(points, seed);
    for (auto& t : tets) std::sort(t.begin(), t.end());
    std::sort(tets.begin(), tets.end());
    return tets;
  };
  EXPECT_EQ(canonical(1), canonical(2));
}

TEST(Delaunay, RefusesNonFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    auto points = random_cube(10, 1);
    points[7][1] = bad;
    EXPECT_THROW(static_cast<void>(delaunay(points)), std::invalid_argument);
  }
}

TEST(Delaunay, LargeCavities) {
  // A sphere's points first form big cells; then the centre replaces them all: thousands of faces.
  std::vector<Point> points;
  std::mt19937_64 random(3);
  std::normal_distribution<double> gauss;
  for (int i = 0; i < 3000; ++i) {
    const double x = gauss(random), y = gauss(random), z = gauss(random);
    const double r = std::sqrt(x * x + y * y + z * z);
    points.push_back({x / r, y / r, z / r});
  }
  points.push_back({0, 0, 0});
  expect_delaunay(points);
}

TEST(Delaunay, CancelLeavesNoTetrahedra) {
  Options options;
  options.progress = [](const Progress& p) {
    EXPECT_EQ(p.stage, Stage::delaunay);
    return false;
  };
  Monitor monitor(options);
  TetMesh mesh = mesh_of(random_cube(300000, 1));
  try {
    build_delaunay(mesh, {}, &monitor);
    FAIL() << "not cancelled";
  } catch (const Interrupted& e) {
    EXPECT_EQ(e.outcome(), Outcome::cancelled);
  }
  EXPECT_EQ(mesh.tet_count(), 0u);
}

}  // namespace
}  // namespace holdfast::delaunay_test
