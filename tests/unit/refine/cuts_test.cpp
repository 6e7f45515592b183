// Planes that cut a mesh into parts, and the points on them.
#include "refine/cuts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "delaunay/delaunay.h"
#include "mesh/editor.h"
#include "mesh/validate.h"
#include "mesh_fixtures.h"
#include "numbers/vector.h"
#include "refine/circumcentre.h"
#include "refine/field_points.h"
#include "refine/front.h"
#include "refine/section_points.h"

namespace holdfast::cuts_test {
namespace {

using testing::corners_of_unit_cube;
using testing::point_in_unit_cube;

/// One region, the convex hull of points, without constraints.
struct DelaunayVolume {
  TetMesh mesh;
  std::vector<RegionId> region_of;
  std::vector<double> sizes;
  const std::vector<bool> kept{true};

  explicit DelaunayVolume(const std::vector<Point>& points) {
    for (const Point& p : points) MeshEditor(mesh).add_vertex(p);
    EXPECT_TRUE(build_delaunay(mesh, {1}, nullptr));
    sizes.assign(mesh.vertex_count(), 0.1);
    region_of.assign(mesh.slot_count(), 0);
  }
  [[nodiscard]] VolumeData data() {
    return {mesh, region_of, sizes, kept, static_cast<Vertex>(sizes.size())};
  }
};

TEST(Cuts, HaveEquallyMuchOnBothSides) {
  std::mt19937_64 random(1);
  std::vector<Cuts::Sample> samples;
  for (int k = 0; k < 20000; ++k) {
    const Point p = point_in_unit_cube(random);
    samples.push_back({p, p[0] < 0.25 ? 3.0 : 1.0});
  }
  const Cuts cuts(samples, 3);
  ASSERT_EQ(cuts.part_count(), 8u);
  std::vector<double> weights(8, 0);
  double total = 0;
  for (const Cuts::Sample& s : samples) {
    weights[cuts.part_of(s.at)] += s.weight;
    total += s.weight;
  }
  for (const double weight : weights) EXPECT_NEAR(weight, total / 8, 0.002 * total);
}

TEST(Cuts, AreAcrossWhatHasPartsOnBothSides) {
  std::mt19937_64 random(2);
  std::vector<Cuts::Sample> samples;
  for (int k = 0; k < 1000; ++k) samples.push_back({point_in_unit_cube(random), 1});
  const Cuts cuts(samples, 2);
  std::size_t across = 0;
  for (int k = 0; k < 1000; ++k) {
    std::array<Point, 4> corners;
    for (Point& p : corners) {
      p = point_in_unit_cube(random);
      for (double& x : p) x = 0.25 * x + 0.001 * (k % 700);
    }
    const auto is_elsewhere = [&](const Point& p) { return cuts.part_of(p) != cuts.part_of(corners[0]); };
    const bool expected = std::any_of(corners.begin(), corners.end(), is_elsewhere);
    EXPECT_EQ(cuts.any_across(corners, [](const Cuts::Plane&) { return true; }), expected);
    EXPECT_FALSE(cuts.any_across(corners, [](const Cuts::Plane&) { return false; }));
    across += expected ? 1 : 0;
  }
  EXPECT_GT(across, 100u);
  EXPECT_LT(across, 900u);
}

TEST(Cuts, GoThroughTheWaist) {
  std::mt19937_64 random(3);
  std::vector<Cuts::Sample> samples;  // a slab whose middle is thin
  while (samples.size() < 4000) {
    const Point p = point_in_unit_cube(random);
    if (std::abs(p[1] - 0.5) < 0.05 + 0.5 * std::abs(p[0] - 0.5)) samples.push_back({p, 1});
  }
  const Cuts cuts(samples, 1);
  EXPECT_NE(cuts.part_of({0.1, 0.5, 0.5}), cuts.part_of({0.9, 0.5, 0.5}));
}

// Like the remains around a plane that has halved a cube, which the same plane halves again.
TEST(Cuts, AwayFromTheMiddleLeaveAloneWhatLiesAlongIt) {
  std::mt19937_64 random(4);
  std::vector<Cuts::Sample> samples;
  while (samples.size() < 4000) {
    const Point p = point_in_unit_cube(random);
    const double x = std::abs(p[0] - 0.5), y = std::abs(p[1] - 0.5), z = std::abs(p[2] - 0.5);
    if (std::min({x, y, z}) < 0.02) samples.push_back({p, 1});
  }
  const auto share_close = [&](double least_share) {
    const Cuts cuts(samples, 1, least_share);
    std::array<std::size_t, 2> below{}, close{};  // by part
    for (const Cuts::Sample& s : samples) {
      const std::uint32_t part = cuts.part_of(s.at);
      bool is_close = false;
      for (std::size_t k = 0; k < 3; ++k)
        for (const double step : {-0.02, 0.02}) {
          Point moved = s.at;
          moved[k] += step;
          is_close = is_close || cuts.part_of(moved) != part;
        }
      ++below[part];
      close[part] += is_close ? 1 : 0;
    }
    EXPECT_GE(static_cast<double>(std::min(below[0], below[1])), 0.99 * least_share * 4000);
    return static_cast<double>(close[0] + close[1]) / 4000;
  };
  EXPECT_GT(share_close(0.5), 0.3);
  EXPECT_LT(share_close(0.25), 0.15);
}

TEST(Cuts, OfNothingOrOfOnePlaceAreNoTrouble) {
  EXPECT_EQ(Cuts({}, 0).part_count(), 1u);
  EXPECT_EQ(Cuts({}, 2, 0.25).part_count(), 4u);
  const Cuts one(std::vector<Cuts::Sample>(10, {{1, 2, 3}, 1}), 2);
  EXPECT_LT(one.part_of({1, 2, 3}), 4u);
}

TEST(SectionPoints, MakeTheCirclesSmallInWhichSpheresMeetTheCuts) {
  DelaunayVolume cube(corners_of_unit_cube());
  std::mt19937_64 random(4);
  std::vector<Cuts::Sample> samples;
  for (int k = 0; k < 1000; ++k) samples.push_back({point_in_unit_cube(random), 1});
  const Cuts cuts(samples, 2);
  const Options options;
  const Sizes sizes{.size = 0.1};
  Kept kept;
  kept.region = {true};
  const SizeFunction size_function(sizes, {}, {}, SegmentTable{}, kept, 0);
  Monitor monitor(options);
  EXPECT_LT(add_section_points(cube.data(), cuts, size_function, 2, monitor), 0.25);
  EXPECT_EQ(find_fault(cube.mesh), "");
  const std::size_t points = cube.mesh.vertex_count() - 8;
  EXPECT_GT(points, 120u);  // two and a half unit squares, in triangles of at least this size
  EXPECT_LT(points, 400u);
  const auto is_small = [&](Tet t, const Cuts::Plane& plane) {
    const Point& p = cube.mesh.position(cube.mesh.corners(t)[0]);
    const ScaledCentre centre = cube.data().see(cube.mesh.corners(t), sphere_centre);
    const double radius2 = dot(centre.at, centre.at) / (centre.scale * centre.scale);
    const double height = p[plane.axis] + centre.at[plane.axis] / centre.scale - plane.at;
    return radius2 - height * height < 0.1 * 0.1;
  };
  std::size_t all = 0, large = 0;
  for (Tet t = 0; t < cube.mesh.slot_count(); ++t) {
    if (!cube.data().is_inside(t)) continue;
    std::array<Point, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = cube.mesh.position(cube.mesh.corners(t)[i]);
    all += cuts.any_across(corners, [](const Cuts::Plane&) { return true; }) ? 1 : 0;
    large += cuts.any_across(corners, [&](const Cuts::Plane& plane) { return !is_small(t, plane); }) ? 1 : 0;
  }
  EXPECT_GT(all, 200u);
  EXPECT_LT(large, all / 4);  // next to the sides of the cube, which have no points
}

// A plate that is too thin for a point between its sides: circles stay as large as its triangles.
TEST(SectionPoints, APlateOfTrianglesMuchLargerThanTheSizeIsNotCut) {
  constexpr double kThickness = 0.004, kSize = 0.006;
  constexpr int kColumns = 20;
  std::vector<Point> points;
  for (int k = 0; k < 2 * kColumns * kColumns; ++k)
    points.push_back(
        {k / 2 % kColumns / (kColumns - 1.0), k / 2 / kColumns / (kColumns - 1.0), k % 2 * kThickness});
  DelaunayVolume plate(points);
  for (Tet t = 0; t < plate.mesh.slot_count(); ++t)
    if (plate.mesh.alive(t) && plate.mesh.is_ghost(t))
      MeshEditor(plate.mesh).set_facet(plate.mesh.neighbour(t, 3));
  const Options options;
  const Sizes sizes{.size = kSize};
  Kept kept;
  kept.region = {true};
  const SizeFunction size_function(sizes, {}, {}, SegmentTable{}, kept, 0);
  Monitor monitor(options);
  const Cuts cuts({{{0.5, 0.5, 0}, 1}, {{0.52, 0.5, 0}, 1}}, 1);
  set_sizes_at_vertices(plate.data(), size_function, 1, monitor);
  EXPECT_GT(add_section_points(plate.data(), cuts, size_function, 2, monitor), 0.9);
  EXPECT_EQ(add_field_points(plate.data(), size_function, 2, monitor).parts, nullptr);
  EXPECT_EQ(find_fault(plate.mesh), "");
}

}  // namespace
}  // namespace holdfast::cuts_test
