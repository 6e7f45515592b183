// The check of repairs: distances decided exactly, and when facets cover a triangle.
#include "holdfast/check_repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "check_repair/cover.h"
#include "check_repair/reach.h"

namespace holdfast {
namespace {

using checking::CoverTest;
using checking::Reach;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Reach, OfATriangleIsExact) {
  const std::array<Point, 3> t{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  for (const double height : {0x1p-60, 0.3, 1e-300, 1e12}) {
    const double less = std::nextafter(height, 0.0), more = std::nextafter(height, kInfinity);
    EXPECT_TRUE(Reach(height).of_triangle({1, 1, height}, t));
    EXPECT_TRUE(Reach(more).of_triangle({1, 1, -height}, t));
    EXPECT_FALSE(Reach(less).of_triangle({1, 1, height}, t));
  }
  // Beside a side and a corner.
  EXPECT_TRUE(Reach(0.25).of_triangle({3, -0.25, 0}, t));
  EXPECT_FALSE(Reach(std::nextafter(0.25, 0.0)).of_triangle({3, -0.25, 0}, t));
  EXPECT_TRUE(Reach(5).of_triangle({8, 0, 3}, t));
  EXPECT_FALSE(Reach(std::nextafter(5.0, 0.0)).of_triangle({8, 0, 3}, t));
  EXPECT_TRUE(Reach(0).of_triangle({2, 2, 0}, t));
  EXPECT_FALSE(Reach(0).of_triangle({2, std::nextafter(2.0, 3.0), 0}, t));
}

TEST(Reach, OfASegmentAndOfAFlatTriangle) {
  const Point a{0, 0, 0}, b{3, 4, 0};
  EXPECT_TRUE(Reach(5).of_segment({-4, 3, 0}, a, b));
  EXPECT_FALSE(Reach(std::nextafter(5.0, 0.0)).of_segment({-4, 3, 0}, a, b));
  EXPECT_TRUE(Reach(0).of_segment({1.5, 2, 0}, a, b));
  const std::array<Point, 3> flat{{a, b, {1.5, 2, 0}}};
  EXPECT_TRUE(Reach(2).of_triangle({1.5, 2, 2}, flat));
  EXPECT_FALSE(Reach(1.999).of_triangle({1.5, 2, 2}, flat));
}

TEST(Reach, InscribedCircle) {
  // Sides 3, 4, 5: radius 1.
  const std::array<Point, 3> t{{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}};
  EXPECT_TRUE(checking::inscribed_at_most(t, 1));
  EXPECT_FALSE(checking::inscribed_at_most(t, 0.999999999));
}

struct Square {
  // Two triangles of the unit square cut at its middle, vertex 4.
  std::vector<Point> vertices{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}};
  std::vector<Triangle> facets{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  std::array<Point, 3> lower{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}};
};

TEST(Cover, ChildrenThatCoverAndThatDoNot) {
  Square s;
  const Reach reach(0);
  CoverTest test(s.vertices, s.facets, reach);
  EXPECT_FALSE(test.gap(s.lower, {0, 1, 2}, std::vector<Index>{0, 1}));
  EXPECT_TRUE(test.gap(s.lower, {0, 1, 2}, std::vector<Index>{0}));
  EXPECT_TRUE(test.gap(s.lower, {0, 1, 2}, std::vector<Index>{}));
}

TEST(Cover, PointsThatMovedWithinReach) {
  Square s;
  s.vertices[4] = {0.5, 0.5 + 1e-10, 1e-10};
  s.vertices[1] = {1, -1e-10, 0};
  const Reach near(2e-10), nearer(0.5e-10);
  EXPECT_FALSE(CoverTest(s.vertices, s.facets, near).gap(s.lower, {0, 1, 2}, std::vector<Index>{0, 1}));
  EXPECT_TRUE(CoverTest(s.vertices, s.facets, nearer).gap(s.lower, {0, 1, 2}, std::vector<Index>{0, 1}));
}

// A triangle whose tip became an edge when two points near it were joined: the edge from 0 to 1 is a side of
// another facet only.
TEST(Cover, ATipThatBecameAnEdge) {
  const std::vector<Point> vertices{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2e-9, 0}, {1, 1, 1}};
  const std::vector<Triangle> facets{{1, 2, 3}, {0, 1, 4}};
  const std::array<Point, 3> thin{{{0, 0, 0}, {2, 0, 0}, {2, 2e-9, 0}}};
  const Reach reach(1e-9);
  EXPECT_FALSE(CoverTest(vertices, facets, reach).gap(thin, {0, 2, 3}, std::vector<Index>{0}));
  const std::vector<Triangle> without{{1, 2, 3}};
  EXPECT_TRUE(CoverTest(vertices, without, reach).gap(thin, {0, 2, 3}, std::vector<Index>{0}));
}

// Several vertices of the output are within reach of a corner, as those round the pole of a sphere, and the
// children have not the first of them.
TEST(Cover, ACornerThatBecameAnyOfSeveralVertices) {
  Square s;
  s.vertices.insert(s.vertices.begin(), {1 + 1e-12, 0, -1e-12});
  for (Triangle& t : s.facets)
    for (Index& v : t) ++v;
  s.facets.push_back({0, 3, 4});
  const Reach reach(1e-11);
  CoverTest test(s.vertices, s.facets, reach);
  EXPECT_FALSE(test.gap(s.lower, {1, no_entity, 3}, std::vector<Index>{0, 1}));
  EXPECT_FALSE(test.gap(s.lower, {1, 0, 3}, std::vector<Index>{0, 1}));
  EXPECT_TRUE(test.gap(s.lower, {1, no_entity, 3}, std::vector<Index>{0}));
}

// A triangle of which two corners are there twice, and its children lead to the one or to the other: large
// children must not go before all thin facets are looked at.
TEST(Cover, CornersThatAreThereTwice) {
  const double e = 1e-12;
  const std::vector<Point> vertices{{-e, 1, 0}, {-e, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  const std::vector<Triangle> facets{{4, 2, 3}, {1, 4, 3}, {1, 2, 4}, {1, 3, 0}};
  const std::array<Point, 3> triangle{vertices[4], vertices[2], vertices[3]};
  const Reach reach(2e-12);
  const std::vector<Index> children{0, 1, 2, 3};
  EXPECT_FALSE(CoverTest(vertices, facets, reach).gap(triangle, {4, 2, 3}, children));
  for (Index k = 0; k < 3; ++k) {
    std::vector<Index> turned = children;
    std::rotate(turned.begin(), turned.begin() + k, turned.end());
    EXPECT_FALSE(CoverTest(vertices, facets, reach).gap(triangle, {4, 2, 3}, turned));
  }
  EXPECT_TRUE(CoverTest(vertices, facets, reach).gap(triangle, {4, 2, 3}, std::vector<Index>{1, 2, 3}));
}

// A child that is all of the triangle covers it, whatever others there are.
TEST(Cover, AChildThatIsAllOfIt) {
  const std::vector<Point> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, 0}, {0.3, 0.2, 0}};
  const std::vector<Triangle> facets{{2, 0, 1}, {0, 3, 4}};
  const std::array<Point, 3> triangle{vertices[0], vertices[1], vertices[2]};
  const Reach reach(0);
  EXPECT_FALSE(CoverTest(vertices, facets, reach).gap(triangle, {0, 1, 2}, std::vector<Index>{1, 0}));
  EXPECT_TRUE(CoverTest(vertices, facets, reach).gap(triangle, {0, 1, 2}, std::vector<Index>{1}));
}

TEST(Cover, Segments) {
  const std::vector<Point> vertices{{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}};
  const Reach reach(0);
  CoverTest test(vertices, {}, reach);
  const std::array<Point, 2> segment{vertices[0], vertices[1]};
  EXPECT_FALSE(test.gap(segment, {0, 1}, std::vector<Segment>{{0, 2}, {1, 2}}));
  EXPECT_TRUE(test.gap(segment, {0, 1}, std::vector<Segment>{{0, 2}}));
  EXPECT_TRUE(test.gap(segment, {0, no_entity}, std::vector<Segment>{{0, 1}}));
}

TEST(CheckRepair, AnyArraysAreAccepted) {
  const std::vector<Point> points{{0, 0, 0}, {std::nan(""), kInfinity, 1e308}, {-1e308, 0, 5e-324}};
  const std::vector<Triangle> facets{{0, 1, 2}, {7, 8, 9}, {0, 0, 0}};
  const std::vector<Segment> segments{{0, 1}, {4, 4}};
  const Complex strange{points, facets, segments, {}, {}};
  RepairClaims claims;
  claims.parents = {{0, 2, 3, 3}, {0, 900, 2}};
  claims.segment_parents = IndexLists{{0, 1, 2}, {5, 0}};
  claims.moved = {{0, -1}, {77, 0.5}, {1, std::nan("")}, {1, 0}};
  claims.dropped = {{9, DropReason::vanished}, {0, DropReason::inner}, {0, DropReason::no_area}};
  claims.merged = {{0, 1}, {8, 8}};
  claims.filled = {{{0, 90}, {0, 70}, true}};
  for (const double distance : {0.0, 1e300, -1.0, kInfinity, std::nan("")}) {
    claims.max_displacement = distance;
    EXPECT_FALSE(check_repaired(strange, strange, claims).holds());
    EXPECT_FALSE(check_repaired({}, strange, claims).holds());
    EXPECT_FALSE(check_repaired(strange, {}, claims).holds());
  }
  EXPECT_TRUE(check_repaired({}, {}, {}).holds());
}

}  // namespace
}  // namespace holdfast
