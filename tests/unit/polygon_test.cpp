// Non-convex polygons in files, polygons that touch themselves or have holes, and facets of several polygons.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "exact/predicates.h"
#include "holdfast/holdfast.h"
#include "io_samples.h"

namespace holdfast {
namespace {

using namespace samples;

std::string text_of(const std::vector<Point>& points) {
  std::string text;
  char line[128];
  for (const Point& p : points) {
    std::snprintf(line, sizeof line, "%.17g %.17g %.17g\n", p[0], p[1], p[2]);
    text += line;
  }
  return text;
}

std::string off_of(const std::vector<Point>& points, const std::vector<Index>& corners) {
  std::string text = "OFF " + std::to_string(points.size()) + " 1 0\n" + text_of(points);
  text += std::to_string(corners.size());
  for (const Index corner : corners) text += " " + std::to_string(corner);
  return text + "\n";
}

class Polygons : public ::testing::Test {
 protected:
  Surface read(const std::string& bytes, const std::string& name, double tolerance = 0) {
    put(folder_ / name, bytes);
    ReadOptions options;
    options.tolerance = tolerance;
    return read_surface(folder_ / name, options);
  }
  std::string error(const std::string& bytes, const std::string& name, double tolerance = 0) {
    try {
      static_cast<void>(read(bytes, name, tolerance));
      return "read";
    } catch (const FileError& failed) {
      const std::string what = failed.what();
      return what.substr(what.find(name) + name.size() + 2);
    }
  }
  TemporaryFolder folder_;
};

/// Twice the area seen along z; every triangle must be counterclockwise.
double area_of(const Surface& s) {
  double sum = 0;
  for (const Triangle& t : s.facets) {
    const Point &a = s.vertices[t[0]], &b = s.vertices[t[1]], &c = s.vertices[t[2]];
    EXPECT_GT(exact::orient2d(a.data(), b.data(), c.data()), 0);
    sum += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  return sum;
}

std::set<std::array<Index, 3>> set_of(const std::vector<Triangle>& triangles) {
  std::set<std::array<Index, 3>> all;
  for (Triangle t : triangles) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    all.insert(t);
  }
  return all;
}

const std::vector<Point> kComb{{0, 0, 0}, {6, 0, 0}, {6, 3, 0}, {5, 3, 0}, {5, 1, 0}, {4, 1, 0}, {4, 3, 0},
                               {3, 3, 0}, {3, 1, 0}, {2, 1, 0}, {2, 3, 0}, {0, 3, 0}, {0, 1, 0}};

TEST_F(Polygons, ConcaveOnesHaveTheSameTrianglesWhateverCornerComesFirst) {
  std::vector<Index> corners(kComb.size());
  for (Index i = 0; i < corners.size(); ++i) corners[i] = i;
  const Surface first = read(off_of(kComb, corners), "a.off");
  EXPECT_EQ(first.facets.size(), kComb.size() - 2);  // the straight corner (0, 1) is one, too
  EXPECT_EQ(area_of(first), 2 * 14);
  ASSERT_EQ(first.remarks.size(), 1u);
  EXPECT_EQ(first.remarks[0].message, "1 polygon of more than three corners is cut into triangles");
  for (std::size_t turn = 1; turn < corners.size(); ++turn) {
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    EXPECT_EQ(set_of(read(off_of(kComb, corners), "a.off").facets), set_of(first.facets)) << turn;
  }
}

TEST_F(Polygons, KeepTheirOrientation) {
  std::vector<Index> corners;
  for (auto i = static_cast<Index>(kComb.size()); i-- > 0;) corners.push_back(i);
  Surface s = read(off_of(kComb, corners), "a.off");
  for (Triangle& t : s.facets) std::swap(t[0], t[1]);
  EXPECT_EQ(area_of(s), 2 * 14);
}

TEST_F(Polygons, LieInAnyPlaneAndAtAnyScale) {
  // Oblique planes of exact doubles, and one whose projection along z is a line.
  const auto lifted = [](double scale, auto&& place) {
    std::vector<Point> points;
    for (const Point& p : kComb) {
      points.push_back(place(p[0], p[1]));
      for (double& x : points.back()) x *= scale;
    }
    return points;
  };
  std::vector<Index> corners(kComb.size());
  for (Index i = 0; i < corners.size(); ++i) corners[i] = i;
  for (const double scale : {1.0, 0x1p-1000, 0x1p1000, 0x1p-1070, 0x1p1015}) {
    for (const auto& points : {lifted(scale,
                                      [](double u, double v) {
                                        return Point{u, v, u + 2 * v};
                                      }),
                               lifted(scale,
                                      [](double u, double v) {
                                        return Point{u, 2 * u, v};
                                      }),
                               lifted(scale,
                                      [](double u, double v) {
                                        return Point{7, u, v};
                                      }),
                               lifted(scale, [](double u, double v) {
                                 return Point{u - v, v - 3 * u, v + u};
                               })}) {
      const Surface s = read(off_of(points, corners), "a.off");
      EXPECT_EQ(s.facets.size(), kComb.size() - 2);
      EXPECT_EQ(bits(s.vertices), bits(points));
      for (const Defect& defect : diagnose(s.view()))
        EXPECT_EQ(defect.kind, DefectKind::encloses_nothing) << defect.message;
    }
  }
}

TEST_F(Polygons, WithABridgeToAHoleAreARing) {
  const std::vector<Point> ring{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0},
                                {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}};
  const Surface s = read(off_of(ring, {0, 1, 2, 3, 0, 4, 5, 6, 7, 4}), "a.off");
  EXPECT_EQ(area_of(s), 2 * 12);
  EXPECT_EQ(s.facets.size(), 8u);
  // The bridge's ends may have separate vertices at the same places.
  std::vector<Point> doubled = ring;
  doubled.push_back(ring[0]);
  doubled.push_back(ring[4]);
  EXPECT_EQ(set_of(read(off_of(doubled, {0, 1, 2, 3, 8, 9, 5, 6, 7, 4}), "a.off").facets), set_of(s.facets));
}

TEST_F(Polygons, MayTouchThemselvesButNotCross) {
  const std::vector<Point> points{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {2, 2, 0}, {0, 2, 0}, {1, 0.5, 0}};
  EXPECT_EQ(area_of(read(off_of(points, {0, 1, 2, 3, 4, 2}), "a.off")), 4);
  EXPECT_EQ(error(off_of(points, {0, 1, 4, 3}), "a.off"),
            "line 8: a polygon of 4 corners that crosses or overlaps itself: its sides 2-3 and 4-1 (by "
            "corner) cross");
  // A figure of eight through a common corner winds round its parts in both directions.
  EXPECT_EQ(error(off_of(points, {0, 1, 2, 4, 3, 2}), "a.off"),
            "line 8: a polygon of 6 corners that crosses or overlaps itself");
  // A fold outside, and a double loop.
  EXPECT_NE(error(off_of(points, {0, 1, 2, 3, 2}), "a.off"), "read");
  EXPECT_NE(error(off_of(points, {0, 1, 5, 0, 1, 5}), "a.off"), "read");
  EXPECT_NE(error(off_of(points, {0, 2, 3, 0, 2, 3}), "a.off"), "read");
}

TEST_F(Polygons, ThatAreNotPlaneMustBeConvexOrWithinTheTolerance) {
  const std::vector<Point> convex{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.25}, {0, 1, 0}};
  const Surface fan = read(off_of(convex, {0, 1, 2, 3}), "a.off");
  EXPECT_EQ(fan.facets, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(
      fan.remarks[0].message,
      "1 polygon of more than three corners is cut into triangles; their corners lie up to 0.0615 from the "
      "mean plane of their polygon");
  std::vector<Point> concave = kComb;
  concave[3][2] = 0.01;
  std::vector<Index> corners(kComb.size());
  for (Index i = 0; i < corners.size(); ++i) corners[i] = i;
  const std::string file = off_of(concave, corners);
  EXPECT_EQ(error(file, "a.off"),
            "line 15: a polygon of 13 corners that is not convex and lies in no plane: its corners are up to "
            "0.0102 away from the mean one; give a larger tolerance, or split it into triangles");
  EXPECT_NE(error(file, "a.off", 0.01), "read");
  const Surface s = read(file, "a.off", 0.011);
  EXPECT_EQ(s.facets.size(), kComb.size() - 2);
  EXPECT_EQ(bits(s.vertices), bits(concave));
  for (const double tolerance : {-1.0, HUGE_VAL, std::nan("")})
    EXPECT_THROW(static_cast<void>(read(file, "a.off", tolerance)), std::invalid_argument);
}

// As written by programs that print six digits, or numbers of single precision.
TEST_F(Polygons, RoundingToSixDigitsOrSinglePrecisionNeedsNoTolerance) {
  const double c = std::cos(0.3), s = std::sin(0.3), d = std::cos(1.1), e = std::sin(1.1);
  std::vector<Point> single;
  std::string six = "OFF\n13 1 0\n";
  for (const Point& p : kComb) {
    const double x = c * p[0] - s * p[1], y = s * p[0] + c * p[1];
    const Point turned{100 + x, d * y, e * y};
    single.push_back({});
    for (std::size_t k = 0; k < 3; ++k) single.back()[k] = static_cast<float>(turned[k]);
    char line[64];
    std::snprintf(line, sizeof line, "%.6g %.6g %.6g\n", turned[0], turned[1], turned[2]);
    six += line;
  }
  std::vector<Index> corners(kComb.size());
  for (Index i = 0; i < corners.size(); ++i) corners[i] = i;
  for (const std::string& file : {off_of(single, corners), six + "13 0 1 2 3 4 5 6 7 8 9 10 11 12\n"}) {
    const Surface read_back = read(file, "a.off");
    EXPECT_EQ(read_back.facets.size(), kComb.size() - 2);
    ASSERT_EQ(read_back.remarks.size(), 1u);  // and reported
    EXPECT_NE(read_back.remarks[0].message.find("from the mean plane"), std::string::npos);
  }
}

// Seen along an axis, two corners of such a polygon may coincide.
TEST_F(Polygons, NearlyPlaneButFoldedIsRefused) {
  const std::vector<Point> points{{0, 0, 0}, {2, 0, 0}, {2, 0, 1e-6}, {1, 0, 2e-6}, {0, 2, 0}};
  EXPECT_NE(error(off_of(points, {0, 1, 2, 3, 4}), "a.off"), "read");
}

TEST_F(Polygons, RoundingAloneNeedsNoTolerance) {
  // Rotated by angles that are not doubles.
  const double c = std::cos(0.3), s = std::sin(0.3), d = std::cos(1.1), e = std::sin(1.1);
  std::vector<Point> points;
  for (const Point& p : kComb) {
    const double x = c * p[0] - s * p[1], y = s * p[0] + c * p[1];
    points.push_back({x + 100, d * y + 1000, e * y});
  }
  std::vector<Index> corners(kComb.size());
  for (Index i = 0; i < corners.size(); ++i) corners[i] = i;
  const Surface read_back = read(off_of(points, corners), "a.off");
  EXPECT_EQ(read_back.facets.size(), kComb.size() - 2);
  EXPECT_EQ(read_back.remarks[0].message, "1 polygon of more than three corners is cut into triangles");
}

TEST_F(Polygons, OfEveryFormat) {
  const std::string points = "0 0 0\n2 0 0\n0.5 0.5 0\n0 2 0\n";
  const auto triangles = set_of({{0, 1, 2}, {0, 2, 3}});
  EXPECT_EQ(set_of(read("v 0 0 0\nv 2 0 0\nv 0.5 0.5 0\nv 0 2 0\nf 2 3 4 1\n", "a.obj").facets), triangles);
  EXPECT_EQ(
      set_of(read("ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty "
                  "double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n" +
                      points + "4 3 0 1 2\n",
                  "a.ply")
                 .facets),
      triangles);
  EXPECT_EQ(set_of(read("# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n" + points +
                            "POLYGONS 1 5\n4 1 2 3 0\n",
                        "a.vtk")
                       .facets),
            triangles);
  EXPECT_EQ(
      set_of(read("4 3 0 0\n0 0 0 0\n1 2 0 0\n2 0.5 0.5 0\n3 0 2 0\n1 0\n1\n4 2 3 0 1\n0\n0\n", "a.poly")
                 .facets),
      triangles);
  EXPECT_EQ(
      set_of(
          read("4 3 0 0\n0 0 0 0\n1 2 0 0\n2 0.5 0.5 0\n3 0 2 0\n1 0\n4 2 3 0 1\n0\n0\n", "a.smesh").facets),
      triangles);
}

const char* const kNodes =
    "12 3 0 0\n0 0 0 1\n1 4 0 1\n2 4 4 1\n3 0 4 1\n4 1 1 1\n5 3 1 1\n6 3 3 1\n7 1 3 1\n8 0.5 0.5 1\n9 0.75 "
    "0.5 1\n"
    "10 0.25 2 1\n11 2 2 1\n";

TEST_F(Polygons, AndHolesOfAFacet) {
  const Surface s =
      read(std::string(kNodes) + "1 1\n4 1 7\n4 0 1 2 3\n4 4 5 6 7\n2 8 9\n1 10\n1 2 2 1\n0\n0\n", "a.poly");
  EXPECT_EQ(area_of(s), 2 * 12);
  EXPECT_EQ(s.facets.size(), 14u);
  EXPECT_EQ(s.segments, (std::vector<Segment>{{8, 9}}));
  EXPECT_EQ(s.facet_markers, std::vector<int>(14, 7));
  // The segment is a side of triangles, and the point a corner.
  std::size_t at_segment = 0, at_point = 0;
  for (const Triangle& t : s.facets) {
    const std::set<Index> corners(t.begin(), t.end());
    at_segment += corners.count(8) + corners.count(9) == 2 ? 1 : 0;
    at_point += corners.count(10);
  }
  EXPECT_EQ(at_segment, 2u);
  EXPECT_GE(at_point, 3u);
}

TEST_F(Polygons, OfAFacetEncloseRegionsTogether) {
  const Surface nested = read(std::string(kNodes) + "1 0\n2\n4 0 1 2 3\n4 4 5 6 7\n0\n0\n", "a.poly");
  EXPECT_EQ(area_of(nested), 2 * 16);
  EXPECT_EQ(nested.facets.size(), 10u);
  EXPECT_EQ(error(std::string(kNodes) + "1 0\n2 1\n4 0 1 2 3\n4 4 5 6 7\n1 1 2 1\n0\n0\n", "a.poly"),
            "line 15: a facet with holes whose sides cross or overlap, or have a hole on them");
  EXPECT_EQ(error(std::string(kNodes) + "1 0\n2 1\n4 0 1 2 3\n4 4 5 6 7\n", "a.poly"),
            "line 18: the file ends where the hole's number is expected; it is truncated");
}

TEST_F(Polygons, ThatNameWhatIsNotFinite) {
  EXPECT_EQ(error("OFF 4 1 0\n0 0 0\n2 0 0\n0.5 nan 0\n0 2 0\n4 0 1 2 3\n", "a.off"),
            "line 6: a polygon of 4 corners of which one is not finite");
}

}  // namespace
}  // namespace holdfast
