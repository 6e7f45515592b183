// Exact tests of two simplices: named cases, one for each way in which interiors meet or just do not, at
// scales where floating point decides nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "surface/contacts.h"
#include "surface/intersect.h"

namespace holdfast::surface_intersect_test {
namespace {

struct Points {
  std::vector<Point> all;

  [[nodiscard]] const double* operator[](std::size_t i) const { return all[i].data(); }
  [[nodiscard]] Simplex simplex(std::vector<Index> corners) const {
    Simplex s;
    s.corners = static_cast<unsigned>(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      s.vertex[i] = corners[i];
      s.point[i] = all[corners[i]].data();
    }
    if (s.corners == 3 && !set_projection(s)) ADD_FAILURE() << "zero area";
    return s;
  }
};

// Every test runs at every scale: powers of two change nothing.
class AtScale : public ::testing::TestWithParam<int> {
 protected:
  [[nodiscard]] Points scaled(std::vector<Point> points) const {
    for (Point& p : points) {
      for (double& x : p) x = std::ldexp(x, GetParam());
    }
    return {points};
  }
};
INSTANTIATE_TEST_SUITE_P(Scales, AtScale, ::testing::Values(0, -40, 1000, -1070));

TEST_P(AtScale, VertexInSegment) {
  const Points p = scaled({{0, 0, 0}, {4, 8, 12}, {1, 2, 3}, {5, 10, 15}, {1, 2, 4}});
  EXPECT_TRUE(in_segment(p[2], p[0], p[1]));
  EXPECT_TRUE(in_segment(p[2], p[1], p[0]));
  EXPECT_FALSE(in_segment(p[3], p[0], p[1])) << "beyond the end";
  EXPECT_FALSE(in_segment(p[4], p[0], p[1])) << "beside it";
  EXPECT_FALSE(in_segment(p[0], p[0], p[1])) << "an end";
}

TEST_P(AtScale, VertexInFacet) {
  const Points p = scaled({{0, 0, 0}, {6, 0, 6}, {0, 6, 6}, {1, 1, 2}, {3, 3, 6}, {1, 1, 3}, {6, 6, 12}});
  const Simplex t = p.simplex({0, 1, 2});
  EXPECT_TRUE(in_facet(p[3], t));
  EXPECT_FALSE(in_facet(p[4], t)) << "on a side";
  EXPECT_FALSE(in_facet(p[5], t)) << "above";
  EXPECT_FALSE(in_facet(p[6], t)) << "in the plane, outside";
  EXPECT_FALSE(in_facet(p[1], t)) << "a corner";
}

TEST_P(AtScale, Segments) {
  const Points p = scaled({{0, 0, 0}, {4, 4, 4}, {4, 0, 4}, {0, 4, 0}, {2, 2, 2}, {8, 8, 8}, {0, 4, 1}});
  EXPECT_EQ(segments_meet(p[0], p[1], p[2], p[3]), Meet::point);
  EXPECT_EQ(segments_meet(p[0], p[1], p[4], p[3]), Meet::none) << "an end inside the other";
  EXPECT_EQ(segments_meet(p[0], p[1], p[4], p[5]), Meet::length);
  EXPECT_EQ(segments_meet(p[1], p[0], p[5], p[4]), Meet::length);
  EXPECT_EQ(segments_meet(p[0], p[5], p[4], p[1]), Meet::length) << "one within the other";
  EXPECT_EQ(segments_meet(p[0], p[1], p[0], p[5]), Meet::length) << "a common end, one direction";
  EXPECT_EQ(segments_meet(p[0], p[1], p[1], p[5]), Meet::none) << "end to end";
  EXPECT_EQ(segments_meet(p[0], p[4], p[1], p[5]), Meet::none) << "collinear, apart";
  EXPECT_EQ(segments_meet(p[0], p[1], p[2], p[6]), Meet::none) << "skew";
}

TEST_P(AtScale, SegmentAndFacet) {
  const Points p = scaled({{0, 0, 0},
                           {8, 0, 0},
                           {0, 8, 0},
                           {2, 2, 1},
                           {2, 2, -1},
                           {4, 4, 1},
                           {4, 4, -1},
                           {2, 2, 0},
                           {-1, 2, 0},
                           {9, 2, 0},
                           {-1, 0, 0},
                           {9, 0, 0},
                           {8, 8, 0}});
  const Simplex t = p.simplex({0, 1, 2});
  EXPECT_EQ(segment_meets_facet(p[3], p[4], t), Meet::point);
  EXPECT_EQ(segment_meets_facet(p[5], p[6], t), Meet::none) << "through a side";
  EXPECT_EQ(segment_meets_facet(p[3], p[7], t), Meet::none) << "ends inside the facet";
  EXPECT_EQ(segment_meets_facet(p[8], p[9], t), Meet::length) << "in the plane, across";
  EXPECT_EQ(segment_meets_facet(p[7], p[9], t), Meet::length) << "in the plane, out of it";
  EXPECT_EQ(segment_meets_facet(p[10], p[11], t), Meet::none) << "along a side";
  EXPECT_EQ(segment_meets_facet(p[0], p[12], t), Meet::length) << "from a corner through the facet";
  EXPECT_EQ(segment_meets_facet(p[1], p[12], t), Meet::none) << "from a corner away from it";
}

TEST_P(AtScale, Facets) {
  const Points p = scaled({{0, 0, 0},
                           {8, 0, 0},
                           {0, 8, 0},  // t
                           {2, 2, -1},
                           {2, 2, 1},
                           {9, 9, 1},  // 3-5
                           {2, 2, 0},
                           {8, 8, 0},  // 6, 7: inside, beyond the long side
                           {4, 0, 0},
                           {4, 0, 4},
                           {4, -8, 0},
                           {4, 0, -4}});  // 8-11
  const Simplex t = p.simplex({0, 1, 2});
  EXPECT_EQ(facets_meet(t, p.simplex({3, 4, 5})), Meet::length);
  EXPECT_EQ(facets_meet(t, p.simplex({4, 5, 6})), Meet::none) << "stands on it with a corner";
  EXPECT_EQ(facets_meet(t, p.simplex({1, 2, 7})), Meet::none) << "coplanar, beyond a common side";
  EXPECT_EQ(facets_meet(t, p.simplex({1, 2, 6})), Meet::area) << "folded flat on a common side";
  EXPECT_EQ(facets_meet(t, p.simplex({0, 7, 1})), Meet::area) << "coplanar, sharing a side, sides cross";
  EXPECT_EQ(facets_meet(t, p.simplex({8, 9, 10})), Meet::none) << "touches a side from outside";
  EXPECT_EQ(facets_meet(t, p.simplex({2, 9, 8})), Meet::none) << "stands on it with a side";
  EXPECT_EQ(facets_meet(t, p.simplex({2, 9, 11})), Meet::length) << "from a corner, across";
  EXPECT_EQ(facets_meet(t, t), Meet::area);
}

TEST_P(AtScale, CommonCorners) {
  const Points p = scaled({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {2, 2, -4}, {2, 2, 4}, {2, -8, 4}, {-4, -4, 0}});
  const auto unscaled = [](std::vector<Point> points) {
    for (Point& q : points) {
      for (double& x : q) x = std::ldexp(x, -GetParam());
    }
    std::sort(points.begin(), points.end());
    return points;
  };
  const Simplex t = p.simplex({0, 1, 2});
  const std::vector<Point> line{{2, 0, 0}, {2, 2, 0}};
  EXPECT_EQ(unscaled(common_corners(t, p.simplex({3, 4, 5}))), line);
  const std::vector<Point> pierced{{2, 2, 0}};
  EXPECT_EQ(unscaled(common_corners(p.simplex({3, 4}), t)), pierced);
  const std::vector<Point> overlap{{0, 0, 0}, {0, 8, 0}, {8, 0, 0}};
  EXPECT_EQ(unscaled(common_corners(t, t)), overlap);
  EXPECT_TRUE(common_corners(t, p.simplex({6})).empty());
}

TEST(Intersect, FlatTrianglesHaveNoProjection) {
  const Points p{{{0, 0, 0}, {0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}, {0.3, 0.3, std::nextafter(0.3, 1)}}};
  Simplex t;
  t.corners = 3;
  t.point = {p[0], p[1], p[2]};
  EXPECT_FALSE(set_projection(t));
  t.point = {p[0], p[1], p[3]};
  EXPECT_TRUE(set_projection(t)) << "one unit in the last place is area";
}

TEST(Intersect, OneUnitInTheLastPlaceDecides) {
  // A vertex on the plane x + y + z = 1.5, and one unit to either side.
  const double up = std::nextafter(0.5, 1), down = std::nextafter(0.5, 0);
  const Points p{{{1.5, 0, 0},
                  {0, 1.5, 0},
                  {0, 0, 1.5},
                  {0.5, 0.5, 0.5},
                  {0.5, 0.5, up},
                  {0.5, 0.5, down},
                  {0, 0, 0},
                  {1, 1, 1}}};
  const Simplex t = p.simplex({0, 1, 2});
  EXPECT_TRUE(in_facet(p[3], t));
  EXPECT_FALSE(in_facet(p[4], t));
  EXPECT_EQ(segment_meets_facet(p[6], p[4], t), Meet::point);
  EXPECT_EQ(segment_meets_facet(p[6], p[3], t), Meet::none);
  EXPECT_EQ(segment_meets_facet(p[6], p[5], t), Meet::none);
  EXPECT_EQ(segment_meets_facet(p[7], p[5], t), Meet::point);
}

TEST(Contacts, SharedSideFoldedFlat) {
  const Points p{{{0, 0, 0}, {4, 0, 0}, {1, 3, 0}, {1, 1, 0}, {1, -3, 0}, {1, 3, 1}}};
  const Simplex t = p.simplex({0, 1, 2});
  const Contacts flat = contacts(t, p.simplex({0, 1, 3}));
  EXPECT_NE(flat.distinct & Contacts::bit(7, 7), 0u);
  EXPECT_NE(flat.distinct & Contacts::bit(7, 4), 0u) << "the free corner lies inside";
  EXPECT_NE(flat.common & Contacts::bit(3, 3), 0u) << "the side is common";
  EXPECT_EQ(contacts(t, p.simplex({0, 1, 4})).distinct, 0u) << "flat, but on the other side";
  EXPECT_EQ(contacts(t, p.simplex({0, 1, 5})).distinct, 0u) << "an edge of 18 degrees";
  EXPECT_TRUE(surely_fit(t, p.simplex({1, 0, 4})));
  EXPECT_FALSE(surely_fit(t, p.simplex({3, 0, 1})));
}

TEST(Contacts, SharedVertexAndOtherwiseCrossing) {
  const Points p{{{0, 0, 0},
                  {4, 0, 0},
                  {0, 4, 0},
                  {2, 2, 1},
                  {1, 1, -1},
                  {-2, -2, 1},
                  {-1, -1, -1},
                  {2, 1, 0},
                  {0, 0, 3}}};
  const Simplex t = p.simplex({0, 1, 2});
  EXPECT_EQ(contacts(t, p.simplex({0, 3, 4})).distinct, Contacts::bit(7, 7) | Contacts::bit(7, 6));
  EXPECT_FALSE(surely_fit(t, p.simplex({0, 3, 4})));
  EXPECT_EQ(contacts(t, p.simplex({0, 5, 6})).distinct, 0u) << "leaves the vertex on the other side";
  EXPECT_TRUE(surely_fit(t, p.simplex({0, 5, 6})));
  // A side of u from the shared vertex runs inside t.
  EXPECT_EQ(contacts(t, p.simplex({0, 7, 8})).distinct, Contacts::bit(7, 2) | Contacts::bit(7, 3));
  EXPECT_EQ(contacts(t, t).distinct, 0u);
  EXPECT_FALSE(surely_fit(t, t)) << "one facet twice is no fit";
}

}  // namespace
}  // namespace holdfast::surface_intersect_test
