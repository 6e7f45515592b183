// The check of repairs: distances decided exactly, and when facets cover a triangle.
#include "holdfast/check_repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "check_repair/cover.h"
#include "check_repair/reach.h"

namespace holdfast::check_repair_test {
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
  // Beyond a side and a corner.
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

// Filters agree with the exact test: points at all distances around a segment and a triangle.
TEST(Reach, IsTheSameHoweverItIsDecided) {
  std::mt19937 random(5);
  const auto small = [&] { return static_cast<double>(static_cast<int>(random() % 9) - 4); };
  for (int k = 0; k < 2000; ++k) {
    const int by = k % 2 == 0 ? 0 : static_cast<int>(random() % 900) - 450;
    const auto point = [&] {
      return Point{std::ldexp(small(), by), std::ldexp(small(), by), std::ldexp(small(), by)};
    };
    const Point a = point(), b = point(), p = point();
    // In integers: the squared distance times the squared length, or times the part beyond an end.
    double along = 0, dd = 0, ww = 0, vv = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double d = std::ldexp(b[i] - a[i], -by), w = std::ldexp(p[i] - a[i], -by), v = w - d;
      along += d * w, dd += d * d, ww += w * w, vv += v * v;
    }
    for (double distance = 0.25; distance < 16; distance += 0.25) {
      const double square = distance * distance;
      const bool is_near = along <= 0    ? ww <= square
                           : along >= dd ? vv <= square
                                         : ww * dd - along * along <= square * dd;
      EXPECT_EQ(Reach(std::ldexp(distance, by)).of_segment(p, a, b), is_near);
      const bool is_near_more = Reach(std::ldexp(distance, by)).of_triangle(p, {a, b, point()});
      EXPECT_TRUE(is_near_more || !is_near);
    }
  }
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

// Several vertices of the output are within reach of a corner, as around the pole of a sphere, and the
// children do not have the first of them.
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

// Two corners of a triangle occur twice, and its children lead to one or the other: large children must not
// come before all thin facets are examined.
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

// A child that equals the whole triangle covers it, whatever others exist.
TEST(Cover, AChildThatIsAllOfIt) {
  const std::vector<Point> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, 0}, {0.3, 0.2, 0}};
  const std::vector<Triangle> facets{{2, 0, 1}, {0, 3, 4}};
  const std::array<Point, 3> triangle{vertices[0], vertices[1], vertices[2]};
  const Reach reach(0);
  EXPECT_FALSE(CoverTest(vertices, facets, reach).gap(triangle, {0, 1, 2}, std::vector<Index>{1, 0}));
  EXPECT_TRUE(CoverTest(vertices, facets, reach).gap(triangle, {0, 1, 2}, std::vector<Index>{1}));
}

// Two gaps, each along one side and no wider than the distance, that share the corner between the sides.
TEST(Cover, GapsAlongTwoSidesThatShareACorner) {
  const double e = 1e-9;
  const std::array<Point, 3> triangle{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}};
  const std::vector<Point> vertices{triangle[0],     triangle[1],     triangle[2],        {0.6, e, 0},
                                    {0.6, 2 * e, 0}, {1 - e, 0.5, 0}, {1 - 2 * e, 0.5, 0}};
  std::vector<Triangle> facets{{0, 1, 3}, {0, 3, 4}, {0, 4, 2}, {4, 1, 6}, {4, 6, 2}, {6, 5, 2}, {5, 1, 2}};
  const std::vector<Index> children{0, 1, 2, 3, 4, 5, 6};
  const Reach reach(2.5 * e), nearer(0.4 * e);
  EXPECT_FALSE(CoverTest(vertices, facets, reach).gap(triangle, {0, 1, 2}, children));
  EXPECT_TRUE(CoverTest(vertices, facets, nearer).gap(triangle, {0, 1, 2}, children));
  // A gap between the sides does not count as one along them.
  const std::vector<Index> without{0, 1, 2, 4, 5, 6};
  EXPECT_TRUE(CoverTest(vertices, facets, reach).gap(triangle, {0, 1, 2}, without));
}

// A gap at a corner of the triangle, where one side leads to another vertex near the corner than the other
// side: the two are the ends of an odd side.
TEST(Cover, AGapWithTwoVerticesNearToACorner) {
  const double e = 1e-9;
  const std::array<Point, 3> triangle{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}};
  const std::vector<Point> vertices{triangle[0],   triangle[1],       triangle[2],
                                    {1 - e, e, 0}, {0.6, 1.5 * e, 0}, {1 - 1.5 * e, 0.5, 0}};
  // The missing triangles are 1 3 4 and 1 3 5, or the quadrilateral of both.
  const std::vector<Triangle> facets{{0, 1, 4}, {0, 4, 2}, {4, 3, 5}, {4, 5, 2}, {5, 1, 2}};
  const std::vector<Index> children{0, 1, 2, 3, 4};
  const Reach reach(2 * e), nearer(1.2 * e);
  EXPECT_FALSE(CoverTest(vertices, facets, reach).gap(triangle, {0, 1, 2}, children));
  EXPECT_TRUE(CoverTest(vertices, facets, nearer).gap(triangle, {0, 1, 2}, children));
}

// A part from a side to a vertex in the middle, thinner than the distance, is missing: two edges that
// coincide otherwise.
TEST(Cover, AThinPartThatBecameALine) {
  const double e = 1e-9;
  const std::array<Point, 3> triangle{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}};
  const std::vector<Point> vertices{triangle[0], triangle[1],     triangle[2],
                                    {0.5, 0, 0}, {0.5 + e, 0, 0}, {0.6, 0.3, 0}};
  const std::vector<Triangle> facets{{0, 3, 5}, {4, 1, 5}, {1, 2, 5}, {2, 0, 5}};
  const std::vector<Index> children{0, 1, 2, 3};
  const Reach reach(e), nearer(0.4 * e);
  EXPECT_FALSE(CoverTest(vertices, facets, reach).gap(triangle, {0, 1, 2}, children));
  EXPECT_TRUE(CoverTest(vertices, facets, nearer).gap(triangle, {0, 1, 2}, children));
}

// A part from a side that is thin all along and ends at a short edge: a slit.
TEST(Cover, AThinPartThatBecameASlit) {
  const double e = 1e-9;
  const std::array<Point, 3> triangle{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}};
  const std::vector<Point> vertices{triangle[0],     triangle[1],   triangle[2],      {0.5, 0, 0},
                                    {0.5 + e, 0, 0}, {0.6, 0.3, 0}, {0.6 + e, 0.3, 0}};
  const std::vector<Triangle> facets{{0, 3, 5}, {4, 1, 6}, {1, 2, 6}, {6, 2, 5}, {2, 0, 5}};
  const std::vector<Index> children{0, 1, 2, 3, 4};
  const Reach reach(1.5 * e), nearer(0.9 * e);
  EXPECT_FALSE(CoverTest(vertices, facets, reach).gap(triangle, {0, 1, 2}, children));
  EXPECT_TRUE(CoverTest(vertices, facets, nearer).gap(triangle, {0, 1, 2}, children));
}

// The same with several edges around its far end.
TEST(Cover, ASlitWithSeveralEdgesAtItsEnd) {
  const double e = 1e-9;
  const std::array<Point, 3> triangle{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}};
  const std::vector<Point> vertices{triangle[0],
                                    triangle[1],
                                    triangle[2],
                                    {0.5, 0, 0},
                                    {0.5 + e, 0, 0},
                                    {0.6, 0.3, 0},
                                    {0.6 + e, 0.3, 0},
                                    {0.6 + e / 4, 0.3 + e / 4, 0},
                                    {0.6 + e / 2, 0.3 + e / 4, 0}};
  const std::vector<Triangle> facets{{0, 3, 5}, {4, 1, 6}, {1, 2, 6}, {6, 2, 8},
                                     {8, 2, 7}, {7, 2, 5}, {2, 0, 5}};
  const std::vector<Index> children{0, 1, 2, 3, 4, 5, 6};
  const Reach reach(1.8 * e), nearer(0.9 * e);
  EXPECT_FALSE(CoverTest(vertices, facets, reach).gap(triangle, {0, 1, 2}, children));
  EXPECT_TRUE(CoverTest(vertices, facets, nearer).gap(triangle, {0, 1, 2}, children));
}

// The same with ends longer than its thickness, because it runs almost along the side where it begins: once
// both of its sides begin and end next to each other, once one of them is shorter at both ends.
TEST(Cover, ASlitWithEndsLongerThanItsThickness) {
  const std::array<Point, 3> triangle{{{0, 0, 0}, {1, 0, 0}, {0.5, 1e-10, 0}}};
  const std::vector<Triangle> facets{{0, 3, 2}, {3, 5, 2}, {5, 6, 2}, {6, 1, 2}, {6, 4, 1}};
  const std::vector<Index> children{0, 1, 2, 3, 4};
  const double e = 1e-5, thickness = e * 1e-11 / 0.25;
  const Reach reach(1.5 * thickness), nearer(0.9 * thickness);
  for (const double x : {0.5 + e, 0.5 - e}) {
    const std::vector<Point> vertices{triangle[0],      triangle[1],     triangle[2],  {0.25, 0, 0},
                                      {0.25 + e, 0, 0}, {0.5, 1e-11, 0}, {x, 1e-11, 0}};
    EXPECT_FALSE(CoverTest(vertices, facets, reach).gap(triangle, {0, 1, 2}, children)) << x;
    EXPECT_TRUE(CoverTest(vertices, facets, nearer).gap(triangle, {0, 1, 2}, children)) << x;
  }
}

// From side to side, once straight and once nearly along the side where it begins.
TEST(Cover, ASlitFromOneSideToAnother) {
  const double e = 1e-9;
  const std::array<Point, 3> triangle{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}};
  const std::vector<Triangle> facets{{0, 3, 5}, {0, 5, 2}, {4, 1, 6}};
  const std::vector<Index> children{0, 1, 2};
  for (const double end : {0.5, e}) {
    const std::vector<Point> vertices{triangle[0],     triangle[1], triangle[2],          {0.5, 0, 0},
                                      {0.5 + e, 0, 0}, {1, end, 0}, {1, end - e * end, 0}};
    const double thickness = e * end / std::hypot(end, 0.5);
    const Reach reach(1.5 * e), nearer(0.4 * thickness);
    EXPECT_FALSE(CoverTest(vertices, facets, reach).gap(triangle, {0, 1, 2}, children)) << end;
    EXPECT_TRUE(CoverTest(vertices, facets, nearer).gap(triangle, {0, 1, 2}, children)) << end;
  }
}

// Slits that cross: their ends in the middle are at a vertex with four odd edges. An edge along the side lies
// between two that begin there.
TEST(Cover, SlitsThatMeetInAVertex) {
  const double e = 1e-9;
  const std::array<Point, 3> triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const std::vector<Point> vertices{triangle[0],     triangle[1], triangle[2],     {0.3, 0, 0},
                                    {0.3 + e, 0, 0}, {0.6, 0, 0}, {0.6 + e, 0, 0}, {0.3, 0.3, 0}};
  const std::vector<Triangle> facets{{0, 3, 7}, {4, 5, 7}, {6, 1, 7}, {1, 2, 7}, {2, 0, 7}};
  const std::vector<Index> children{0, 1, 2, 3, 4};
  const Reach reach(e), nearer(0.2 * e);
  EXPECT_FALSE(CoverTest(vertices, facets, reach).gap(triangle, {0, 1, 2}, children));
  EXPECT_TRUE(CoverTest(vertices, facets, nearer).gap(triangle, {0, 1, 2}, children));
}

// What is accepted as covered beside a slit is: a corner is cut off by slits of all thicknesses and
// directions.
TEST(Cover, IsTakenForNoneWhereASlitIsTooWide) {
  const std::array<Point, 3> triangle{{{0, 0, 0}, {6, 0, 0}, {1, 5, 0}}};
  const std::vector<Triangle> facets{{0, 3, 5}, {4, 1, 6}, {1, 2, 6}};
  const std::vector<Index> children{0, 1, 2};
  const double distance = 0.01;
  const Reach reach(distance);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(0, 1);
  std::size_t covers = 0;
  for (int round = 0; round < 2000; ++round) {
    const double x = 5.8 * unit(random), y = 0.96 * unit(random);
    const double wide = 0.05 * unit(random) * unit(random), high = 0.01 * unit(random) * unit(random);
    const std::vector<Point> vertices{triangle[0],
                                      triangle[1],
                                      triangle[2],
                                      {x, 0, 0},
                                      {x + wide, 0, 0},
                                      {y, 5 * y, 0},
                                      {y + high, 5 * (y + high), 0}};
    if (CoverTest(vertices, facets, reach).gap(triangle, {0, 1, 2}, children)) continue;
    ++covers;
    constexpr int kParts = 16;
    for (int i = 0; i <= kParts; ++i)
      for (int j = 0; j <= kParts; ++j) {
        const double s = static_cast<double>(i) / kParts, t = static_cast<double>(j) / kParts;
        const double on_first = x + s * wide, on_last = y + s * high;
        const Point p{(1 - t) * on_first + t * on_last, 5 * t * on_last, 0};
        EXPECT_TRUE(std::any_of(
            facets.begin(), facets.end(),
            [&](const Triangle& f) {
              return Reach(distance + 1e-12).of_triangle(p, {vertices[f[0]], vertices[f[1]], vertices[f[2]]});
            }))
            << x << " " << y << " " << wide << " " << high;
      }
  }
  EXPECT_GT(covers, 100U);
  EXPECT_LT(covers, 1900U);
}

// Whatever is accepted as a cover is one: points of the triangle are within the distance of some facet.
TEST(Cover, IsTakenForNoneWhereAPointIsTooFar) {
  const std::array<Point, 3> triangle{{{0, 0, 0}, {6, 0, 0}, {1, 5, 0}}};
  const double distance = 1.25;
  const Reach reach(distance);
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) { return static_cast<Index>(random() % n); };
  std::vector<Point> vertices;
  for (double x = -1; x <= 7; x += 1)
    for (double y = -1; y <= 6; y += 1)
      for (const double z : {0.0, 0.5})
        if (const Point p{x, y, z}; reach.of_triangle(p, triangle)) vertices.push_back(p);
  std::size_t covers = 0;
  for (int round = 0; round < 4000; ++round) {
    // A coarse choice of vertices, so that facets share sides.
    std::vector<Index> some(7);
    for (Index& v : some) v = below(vertices.size());
    std::vector<Triangle> facets;
    std::vector<Index> children;
    for (int k = 0; k < 14; ++k)
      if (const Triangle t{some[below(7)], some[below(7)], some[below(7)]};
          t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
        if (k < 7) children.push_back(static_cast<Index>(facets.size()));
        facets.push_back(t);
      }
    if (CoverTest(vertices, facets, reach).gap(triangle, {no_entity, no_entity, no_entity}, children))
      continue;
    ++covers;
    constexpr int kParts = 24;
    for (int i = 0; i <= kParts; ++i)
      for (int j = 0; i + j <= kParts; ++j) {
        const double s = static_cast<double>(i) / kParts, t = static_cast<double>(j) / kParts;
        const Point p{6 * s + t, 5 * t, 0};
        EXPECT_TRUE(std::any_of(facets.begin(), facets.end(), [&](const Triangle& f) {
          return Reach(distance + 1e-12).of_triangle(p, {vertices[f[0]], vertices[f[1]], vertices[f[2]]});
        }));
      }
  }
  EXPECT_GT(covers, 100U);
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
}  // namespace holdfast::check_repair_test
