// Refinement in the plane: positive, constrained Delaunay triangles whose angles and edges keep the bounds,
// except where the input itself has small angles; it terminates for every input.
#include <gtest/gtest.h>

#include <cmath>

#include "holdfast/names.h"
#include "plane_inputs.h"

namespace holdfast::plane_refine_test {
namespace {

using testing::fault_of;
using testing::random_plane;

constexpr double kDegree = 3.14159265358979323846 / 180;

double distance(const PlanePoint& a, const PlanePoint& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

double least_angle(const PlaneMesh& mesh, const Triangle& t) {
  double least = 180;
  for (std::size_t i = 0; i < 3; ++i) {
    const PlanePoint &a = mesh.points[t[i]], &b = mesh.points[t[(i + 1) % 3]],
                     &c = mesh.points[t[(i + 2) % 3]];
    const double x = (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1]);
    const double y = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    least = std::min(least, std::atan2(y, x) / kDegree);
  }
  return least;
}

double area_of(const PlaneMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const PlanePoint &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    sum += ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
  }
  return sum;
}

/// The points of the input come first, bit for bit, and pieces of segments lie on them within rounding.
void expect_kept(const Plane& plane, const PlaneMesh& mesh) {
  ASSERT_GE(mesh.points.size(), plane.points.size());
  for (std::size_t v = 0; v < plane.points.size(); ++v) ASSERT_EQ(mesh.points[v], plane.points[v]);
  std::size_t s = 0;
  Index at = mesh.segments.empty() ? 0 : mesh.segments[0][0];
  for (const Segment& piece : mesh.segments) {
    ASSERT_LT(s, plane.segments.size());
    const auto [a, b] = plane.segments[s];
    ASSERT_EQ(piece[0], at);
    const PlanePoint &p = plane.points[a], &q = plane.points[b], &r = mesh.points[piece[1]];
    const double off =
        std::abs((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / distance(p, q);
    double most = 0;
    for (const double x : {p[0], p[1], q[0], q[1]}) most = std::max(most, std::abs(x));
    ASSERT_LE(off, most * 0x1p-50);
    at = piece[1];
    if (at == b && ++s < plane.segments.size()) at = plane.segments[s][0];
  }
  ASSERT_EQ(s, plane.segments.size());
}

TEST(PlaneRefinement, KeepsItsBoundsOnRandomInputs) {
  std::size_t solved = 0, added = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    const Plane plane = random_plane(seed, 25);
    double most = 0;
    for (const PlanePoint& p : plane.points) most = std::max({most, std::abs(p[0]), std::abs(p[1])});
    const bool fine = most > 0x1p-1000 && most < 0x1p50;  // doubles leave room for points
    for (const double angle : {20.0, 26.45, 30.0}) {
      PlaneOptions options;
      options.method = values_of<PlaneMethod>()[seed % values_of<PlaneMethod>().size()];
      options.angle = angle;
      options.max_points = 20000;
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", angle " << angle);
      const PlaneResult result = triangulate(plane, options);
      if (result.outcome != Outcome::done) continue;
      ++solved;
      const PlaneReport& report = result.report;
      if (result.mesh.triangles.size() < 400) {
        Plane refined;
        refined.points = result.mesh.points;
        refined.segments = result.mesh.segments;
        ASSERT_EQ(fault_of(refined, result.mesh, true), "");
      }
      ASSERT_EQ(result.mesh.points.size(), plane.points.size() + report.field_points + report.segment_points);
      if (!fine || report.capped) continue;
      added += report.field_points + report.segment_points;
      expect_kept(plane, result.mesh);
      std::size_t below = 0;
      double least = 180;
      for (const Triangle& t : result.mesh.triangles) {
        least = std::min(least, least_angle(result.mesh, t));
        below += least_angle(result.mesh, t) < angle - 1e-9;
      }
      EXPECT_NEAR(report.least_angle, least, 1e-6);
      EXPECT_LE(below, report.small_angles + report.small_angles_left);
      EXPECT_EQ(report.small_angles_left, 0u);
    }
  }
  EXPECT_GT(solved, 100u);
  EXPECT_GT(added, 1000u);
}

TEST(PlaneRefinement, BoundsEdgesAndAreas) {
  Plane plane;
  plane.points = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {5, 0}, {5, 10}};
  plane.segments = {{0, 4}, {4, 1}, {1, 2}, {2, 5}, {5, 3}, {3, 0}, {4, 5}};
  plane.segment_markers = {1, 2, 3, 4, 5, 6, 7};
  plane.point_markers = {9, 9, 9, 9, 9, 9};
  plane.regions = {{{1, 1}, 5, 0.25}};
  PlaneOptions options;
  options.size = 2;
  const PlaneResult result = triangulate(plane, options);
  ASSERT_EQ(result.outcome, Outcome::done);
  const PlaneMesh& mesh = result.mesh;
  EXPECT_NEAR(area_of(mesh), 100, 1e-9);
  EXPECT_GE(result.report.least_angle, 20 - 1e-9);
  EXPECT_EQ(result.report.large_left, 0u);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LE(distance(mesh.points[t[k]], mesh.points[t[(k + 1) % 3]]), 2);
    if (mesh.regions[i] == 5) {
      EXPECT_LE(area_of({mesh.points, {t}, {}, {}, {}, {}}), 0.25);
    }
  }
  ASSERT_EQ(mesh.segment_markers.size(), mesh.segments.size());
  ASSERT_EQ(mesh.point_markers.size(), mesh.points.size());
  for (std::size_t s = 0; s < mesh.segments.size(); ++s)
    if (mesh.segments[s][1] >= 6) {
      EXPECT_EQ(mesh.point_markers[mesh.segments[s][1]], mesh.segment_markers[s]);
    }
}

TEST(PlaneRefinement, EndsAtSmallAnglesOfTheInput) {
  // Segments from one point at 3 degrees to each other, of different lengths.
  Plane fan;
  fan.points.push_back({0, 0});
  for (int i = 0; i < 20; ++i) {
    const double length = 1 + 0.37 * (i * 7 % 5), angle = 3 * i * kDegree;
    fan.points.push_back({length * std::cos(angle), length * std::sin(angle)});
    fan.segments.push_back({0, static_cast<Index>(i + 1)});
    if (i > 0) fan.segments.push_back({static_cast<Index>(i), static_cast<Index>(i + 1)});
  }
  PlaneOptions options;
  options.angle = 26.4;
  const PlaneResult result = triangulate(fan, options);
  ASSERT_EQ(result.outcome, Outcome::done);
  EXPECT_FALSE(result.report.capped);
  EXPECT_GT(result.report.small_angles, 0u);
  EXPECT_EQ(result.report.small_angles_left, 0u);
  EXPECT_LT(result.report.field_points + result.report.segment_points, 5000u);
}

TEST(PlaneRefinement, AddsNoPointOnABoundaryThatIsKept) {
  Plane plane;
  constexpr int kSides = 60;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 360.0 / kSides * i * kDegree;
    plane.points.push_back({3 * std::cos(angle), std::sin(angle)});
    plane.segments.push_back({static_cast<Index>(i), static_cast<Index>((i + 1) % kSides)});
  }
  PlaneOptions options;
  options.angle = 25;
  options.size = 0.4;
  options.keep_boundary = true;
  const PlaneResult result = triangulate(plane, options);
  ASSERT_EQ(result.outcome, Outcome::done);
  EXPECT_EQ(result.report.segment_points, 0u);
  EXPECT_GT(result.report.field_points, 50u);
  EXPECT_EQ(result.mesh.segments, plane.segments);
  Plane refined = plane;
  refined.points = result.mesh.points;
  EXPECT_EQ(fault_of(refined, result.mesh, true), "");
  EXPECT_GT(result.report.least_angle, 15);
}

TEST(PlaneRefinement, StopsAtTheMostPoints) {
  Plane plane;
  plane.points = {{0, 0}, {1, 0}, {0, 1}};
  plane.segments = {{0, 1}, {1, 2}, {2, 0}};
  PlaneOptions options;
  options.size = 0.001;
  options.max_points = 100;
  const PlaneResult result = triangulate(plane, options);
  ASSERT_EQ(result.outcome, Outcome::done);
  EXPECT_TRUE(result.report.capped);
  EXPECT_GT(result.report.large_left, 0u);
  EXPECT_EQ(result.mesh.points.size(), 103u);
}

TEST(PlaneRefinement, RefusesWhatItCannotMean) {
  Plane plane;
  plane.points = {{0, 0}, {1, 0}, {0, 1}};
  plane.segments = {{0, 1}, {1, 2}, {2, 0}};
  const auto refused = [&](auto&& set) {
    PlaneOptions options;
    set(options);
    EXPECT_THROW(static_cast<void>(triangulate(plane, options)), std::invalid_argument);
  };
  refused([](PlaneOptions& o) { o.size = -1; });
  refused([](PlaneOptions& o) { o.size = HUGE_VAL; });
  refused([](PlaneOptions& o) { o.angle = 35; });
  refused([](PlaneOptions& o) { o.angle = std::nan(""); });
  refused([](PlaneOptions& o) { o.keep_boundary = true; });
  refused([](PlaneOptions& o) { o.angle = 20, o.stop_after = PlaneStage::delaunay; });
}

}  // namespace
}  // namespace holdfast::plane_refine_test
