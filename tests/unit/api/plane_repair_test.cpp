// Segments that cross, overlap, end on others or pass through points, cut where they meet.
#include "holdfast/plane_repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace holdfast::plane_repair_test {
namespace {

Plane plane_of(std::vector<PlanePoint> points, std::vector<Segment> segments) {
  Plane plane;
  plane.points = std::move(points);
  plane.segments = std::move(segments);
  return plane;
}

RepairOptions within(double weld) {
  RepairOptions options;
  options.weld = weld;
  return options;
}

bool is_valid(const Plane& plane) { return diagnose(plane).empty(); }

// A square of two by two, its corners counterclockwise from the origin.
const std::vector<PlanePoint> kCorners{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
const std::vector<Segment> kSides{{0, 1}, {1, 2}, {2, 3}, {3, 0}};

Plane square_with(std::vector<PlanePoint> points, std::vector<Segment> segments) {
  Plane plane = plane_of(kCorners, kSides);
  plane.points.insert(plane.points.end(), points.begin(), points.end());
  plane.segments.insert(plane.segments.end(), segments.begin(), segments.end());
  return plane;
}

TEST(RepairPlane, LeavesWhatIsValidBitForBit) {
  Plane plane = square_with({{0.1, 0.3}}, {});
  plane.point_markers = {1, 2, 3, 4, 5};
  plane.segment_markers = {6, 7, 8, 9};
  plane.holes = {{5, 5}};
  plane.base = 1;
  const PlaneRepair repaired = repair(plane);
  ASSERT_EQ(repaired.outcome, Outcome::done);
  EXPECT_TRUE(repaired.report.changes_nothing());
  EXPECT_EQ(repaired.plane.points, plane.points);
  EXPECT_EQ(repaired.plane.segments, plane.segments);
  EXPECT_EQ(repaired.plane.point_markers, plane.point_markers);
  EXPECT_EQ(repaired.plane.segment_markers, plane.segment_markers);
  EXPECT_EQ(repaired.plane.holes, plane.holes);
  EXPECT_EQ(repaired.plane.base, 1);
  EXPECT_EQ(repaired.report.max_displacement, 0);
}

// Both ends of a wall lie on sides, and two walls cross.
TEST(RepairPlane, CutsWhereSegmentsEndOnOthersAndCross) {
  Plane plane = square_with({{1, 0}, {1, 2}, {0, 1}, {2, 1}}, {{4, 5}, {6, 7}});
  plane.segment_markers = {1, 2, 3, 4, 5, 6};
  EXPECT_FALSE(is_valid(plane));
  const PlaneRepair repaired = repair(plane);
  ASSERT_TRUE(is_valid(repaired.plane));
  ASSERT_EQ(repaired.plane.points.size(), 9u);
  EXPECT_EQ(repaired.plane.points[8], (PlanePoint{1, 1}));
  EXPECT_EQ(repaired.report.cut_segments, 6u);
  EXPECT_EQ(repaired.report.new_points, 1u);
  EXPECT_EQ(repaired.plane.segments.size(), 12u);
  ASSERT_EQ(repaired.segment_parents.size(), 12u);
  for (std::size_t s = 0; s < 12; ++s) {
    ASSERT_EQ(repaired.segment_parents[s].size(), 1u);
    EXPECT_EQ(repaired.plane.segment_markers[s], static_cast<int>(repaired.segment_parents[s][0]) + 1);
  }
  EXPECT_EQ(triangulate(repaired.plane).report.regions, 4u);
}

TEST(RepairPlane, OverlapsBecomeOnePieceWithTheFirstMarkerThatIsNotZero) {
  Plane plane = square_with({{-1, 0}, {1, 0}}, {{4, 5}, {0, 1}, {2, 2}});
  plane.segment_markers = {0, 0, 0, 0, 8, 9, 7};
  const PlaneRepair repaired = repair(plane);
  ASSERT_TRUE(is_valid(repaired.plane));
  EXPECT_EQ(repaired.report.left_out_segments, 2u) << "one that is there twice, and one without length";
  int of_left = 0, of_right = 0;
  for (std::size_t s = 0; s < repaired.plane.segments.size(); ++s) {
    const auto [a, b] = repaired.plane.segments[s];
    if (std::minmax(a, b) == std::minmax(Index{0}, Index{5})) of_left = repaired.plane.segment_markers[s];
    if (std::minmax(a, b) == std::minmax(Index{5}, Index{1})) of_right = repaired.plane.segment_markers[s];
  }
  EXPECT_EQ(of_left, 8);
  EXPECT_EQ(of_right, 9);
}

TEST(RepairPlane, PointsAtOnePlaceBecomeOneAndTheOthersKeepTheirOrder) {
  Plane plane =
      plane_of({{7, 7}, {0, 0}, {2, 0}, {2, 0}, {2, 2}, {0, 0}, {7, 7}, {1, 0}}, {{1, 2}, {3, 4}, {4, 5}});
  plane.point_markers = {1, 2, 3, 4, 5, 6, 7, 8};
  const PlaneRepair repaired = repair(plane);
  ASSERT_TRUE(is_valid(repaired.plane));
  EXPECT_EQ(repaired.points, (std::vector<Index>{0, 1, 2, 4, 7}));
  EXPECT_EQ(repaired.plane.point_markers, (std::vector<int>{1, 2, 3, 5, 8}));
  EXPECT_EQ(repaired.report.joined_points, 3u);
  EXPECT_EQ(repaired.report.cut_segments, 1u) << "at a point on no segment";
}

// As in drawings: a wall ends short of a side, another beyond one, and a corner is not closed.
TEST(RepairPlane, JoinsWithinADistance) {
  const double d = 1e-7;
  const Plane plane = plane_of({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {d, -d}, {1, d}, {1.2, 2 + d}},
                               {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {5, 6}});
  EXPECT_NE(triangulate(repair(plane).plane).report.regions, 2u);
  const PlaneRepair repaired = repair(plane, within(1e-6));
  ASSERT_TRUE(is_valid(repaired.plane));
  const PlaneResult result = triangulate(repaired.plane);
  ASSERT_EQ(result.outcome, Outcome::done);
  EXPECT_EQ(result.report.regions, 2u);
  EXPECT_GE(repaired.report.joined_points, 1u);
  EXPECT_LE(repaired.report.max_displacement, 1e-6);
  EXPECT_GT(repaired.report.max_displacement, 0);
}

// A long wall on which many others end, each a little short of it or beyond it.
TEST(RepairPlane, JoinsAnyNumberOfEndsToASegment) {
  constexpr Index kWalls = 600;
  const double tolerance = 1e-6;
  Plane plane = plane_of({{0, 0}, {kWalls, 0}, {kWalls, 1}, {0, 1}}, kSides);
  for (Index k = 1; k < kWalls; ++k) {
    const auto n = static_cast<Index>(plane.points.size());
    const double off = (k % 2 == 0 ? 0.4 : -0.4) * tolerance;
    plane.points.insert(plane.points.end(), {{1.0 * k, off}, {1.0 * k, 1 + off}});
    plane.segments.push_back({n, n + 1});
  }
  const PlaneRepair repaired = repair(plane, within(tolerance));
  ASSERT_EQ(repaired.outcome, Outcome::done);
  EXPECT_EQ(repaired.report.new_points, 0u);
  EXPECT_LE(repaired.report.max_displacement, tolerance);
  EXPECT_EQ(triangulate(repaired.plane).report.regions, std::size_t{kWalls});
}

// The longer segment is led through the ends of the shorter one.
TEST(RepairPlane, WhatBecomesTheSamePieceIsThereOnce) {
  Plane plane = square_with({{0.5, 1e-8}, {1.5, -1e-8}}, {{4, 5}});
  plane.segment_markers = {0, 2, 3, 4, 5};
  const PlaneRepair repaired = repair(plane, within(1e-6));
  ASSERT_TRUE(is_valid(repaired.plane));
  ASSERT_EQ(repaired.plane.segments.size(), 6u);
  const auto inner = std::find_if(repaired.plane.segments.begin(), repaired.plane.segments.end(),
                                  [](const Segment& s) { return s[0] + s[1] == 9; });
  const auto s = static_cast<std::size_t>(inner - repaired.plane.segments.begin());
  ASSERT_LT(s, 6u);
  EXPECT_EQ(std::vector<Index>(repaired.segment_parents[s].begin(), repaired.segment_parents[s].end()),
            (std::vector<Index>{0, 4}));
  EXPECT_EQ(repaired.plane.segment_markers[s], 5);
  EXPECT_EQ(repaired.report.left_out_segments, 1u);
}

TEST(RepairPlane, LeavesWhatItCannotCutForDiagnose) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const PlaneRepair not_finite = repair(square_with({{nan, 0}, {1, 1}}, {{4, 5}}));
  EXPECT_EQ(not_finite.outcome, Outcome::done);
  EXPECT_EQ(not_finite.plane.points.size(), 6u);
  EXPECT_TRUE(not_finite.report.changes_nothing());
  EXPECT_FALSE(is_valid(not_finite.plane));
  EXPECT_EQ(repair(square_with({}, {{0, 17}})).plane.segments.size(), 5u);
  EXPECT_EQ(repair(Plane{}).outcome, Outcome::done);
  EXPECT_THROW((void)repair(Plane{}, within(-1)), std::invalid_argument);
}

TEST(RepairPlane, EndsWithItsLimits) {
  RepairOptions options;
  options.progress = [](double) { return false; };
  const PlaneRepair repaired = repair(square_with({}, {{0, 2}, {1, 3}}), options);
  EXPECT_EQ(repaired.outcome, Outcome::cancelled);
  EXPECT_TRUE(repaired.plane.points.empty());
}

// Random segments cross everywhere; the pieces are valid, and near those that they come from.
TEST(RepairPlane, RandomSegmentsBecomeValid) {
  std::mt19937 random(7);
  for (const double span : {1.0, 0.1}) {
    for (const double weld : {0.0, 1e-4}) {
      std::uniform_real_distribution<double> place(0, 1), part(-span, span);
      Plane plane;
      for (Index s = 0; s < 150; ++s) {
        const PlanePoint a{place(random), place(random)};
        plane.points.push_back(a);
        plane.points.push_back({a[0] + part(random), a[1] + part(random)});
        plane.segments.push_back({2 * s, 2 * s + 1});
      }
      const PlaneRepair repaired = repair(plane, within(weld));
      ASSERT_EQ(repaired.outcome, Outcome::done);
      EXPECT_TRUE(is_valid(repaired.plane));
      EXPECT_GT(repaired.report.new_points, 30u);
      EXPECT_LE(repaired.report.max_displacement, weld + 1e-14);
      for (std::size_t k = 0; k < repaired.points.size(); ++k) {
        const PlanePoint &p = plane.points[repaired.points[k]], &q = repaired.plane.points[k];
        EXPECT_LE(std::hypot(p[0] - q[0], p[1] - q[1]), weld);
      }
    }
  }
}

// A plane that is inclined to all axes.
TEST(RepairPlane, PointsInSpaceStayOnTheirSegments) {
  const auto at = [](double x, double y) { return Point{x, y, 0.5 * x + 0.25 * y + 3}; };
  const std::vector<Point> points{at(0, 0), at(2, 0), at(2, 2), at(0, 2), at(0, 0)};
  const std::vector<Segment> segments{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {0, 2}, {1, 3}};
  const PlanesInSpace given = plane_in_space(points, segments);
  EXPECT_EQ(triangulate(given).outcome, Outcome::invalid_input);
  const PlanesRepair repaired = repair(given);
  ASSERT_EQ(repaired.outcome, Outcome::done);
  EXPECT_EQ(repaired.report.new_points, 1u);
  ASSERT_EQ(repaired.planes.points.size(), 6u);
  EXPECT_EQ(repaired.planes.points[5], at(1, 1));
  EXPECT_TRUE(std::equal(points.begin(), points.end(), repaired.planes.points.begin()));
  const PlaneResult result = triangulate(repaired.planes);
  ASSERT_EQ(result.outcome, Outcome::done);
  EXPECT_EQ(result.report.regions, 4u);
}

TEST(RepairPlane, SeveralPlanesAreNotJoinedWithinADistance) {
  PlanesInSpace planes;
  planes.parts.resize(2);
  EXPECT_EQ(repair(planes).outcome, Outcome::done);
  EXPECT_THROW((void)repair(planes, within(1)), std::invalid_argument);
}

}  // namespace
}  // namespace holdfast::plane_repair_test
