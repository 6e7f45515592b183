// Polygons in files that are not convex or not plane, that touch or cross themselves or have holes, and
// facets of several polygons.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "exact/predicates.h"
#include "holdfast/holdfast.h"
#include "io_samples.h"

namespace holdfast::polygon_test {
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

std::vector<Index> range(std::size_t count) {
  std::vector<Index> numbers(count);
  std::iota(numbers.begin(), numbers.end(), Index{0});
  return numbers;
}

/// How often each side is passed from its lower end to the upper one, minus how often it is passed back.
using NetSides = std::map<std::pair<Index, Index>, int>;

void pass(NetSides& sides, Index a, Index b) {
  if (a == b) return;
  sides[std::minmax(a, b)] += a < b ? 1 : -1;
}

NetSides without_zeros(const NetSides& sides) {
  NetSides left;
  for (const auto& [ends, net] : sides)
    if (net != 0) left.emplace(ends, net);
  return left;
}

NetSides sides_of(const std::vector<Triangle>& triangles) {
  NetSides sides;
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) pass(sides, t[i], t[(i + 1) % 3]);
  return without_zeros(sides);
}

NetSides sides_of(const std::vector<Index>& corners) {
  NetSides sides;
  for (std::size_t i = 0; i < corners.size(); ++i) pass(sides, corners[i], corners[(i + 1) % corners.size()]);
  return without_zeros(sides);
}

/// The same by the first vertex at each place.
NetSides places_of(const NetSides& sides, const std::vector<Point>& points) {
  const auto place = [&](Index i) {
    return static_cast<Index>(std::find(points.begin(), points.end(), points[i]) - points.begin());
  };
  NetSides all;
  for (const auto& [ends, net] : sides)
    for (int k = 0; k < std::abs(net); ++k)
      net > 0 ? pass(all, place(ends.first), place(ends.second))
              : pass(all, place(ends.second), place(ends.first));
  return without_zeros(all);
}

const std::vector<Point> kCrossable{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {2, 2, 0}, {0, 2, 0}, {1, 0.5, 0}};

const std::vector<Point> kComb{{0, 0, 0}, {6, 0, 0}, {6, 3, 0}, {5, 3, 0}, {5, 1, 0}, {4, 1, 0}, {4, 3, 0},
                               {3, 3, 0}, {3, 1, 0}, {2, 1, 0}, {2, 3, 0}, {0, 3, 0}, {0, 1, 0}};

TEST_F(Polygons, ConcaveOnesHaveTheSameTrianglesWhateverCornerComesFirst) {
  std::vector<Index> corners = range(kComb.size());
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
  const std::vector<Index> corners = range(kComb.size());
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

TEST_F(Polygons, MayTouchThemselves) {
  const Surface s = read(off_of(kCrossable, {0, 1, 2, 3, 4, 2}), "a.off");
  EXPECT_EQ(area_of(s), 4);
  EXPECT_EQ(s.remarks[0].message, "1 polygon of more than three corners is cut into triangles");
}

TEST_F(Polygons, ThatCrossThemselvesBecomeTrianglesWithTheSameSides) {
  const std::vector<Index> crossed{0, 1, 4, 3};
  // A figure of eight through a common corner, a fold outside, and double loops.
  for (const std::vector<Index>& corners :
       {crossed, {0, 1, 2, 4, 3, 2}, {0, 1, 2, 3, 2}, {0, 1, 5, 0, 1, 5}, {0, 3, 4, 0, 3, 4}}) {
    const Surface s = read(off_of(kCrossable, corners), "a.off");
    EXPECT_EQ(sides_of(s.facets), sides_of(corners));
    EXPECT_EQ(s.remarks[0].message,
              "1 polygon of more than three corners is cut into triangles; the sides of 1 cross or overlap, "
              "and triangles of such a polygon may cross, too");
  }
  const Surface s = read(off_of(kCrossable, crossed), "a.off");
  const std::vector<Defect> defects = diagnose(s.view());
  EXPECT_TRUE(std::any_of(defects.begin(), defects.end(),
                          [](const Defect& d) { return d.kind == DefectKind::facets_overlap; }));
}

TEST_F(Polygons, ThatAreConvexButNotPlaneAreFans) {
  const std::vector<Point> convex{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.25}, {0, 1, 0}};
  const Surface fan = read(off_of(convex, {0, 1, 2, 3}), "a.off");
  EXPECT_EQ(fan.facets, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(
      fan.remarks[0].message,
      "1 polygon of more than three corners is cut into triangles; their corners lie up to 0.0615 from the "
      "mean plane of their polygon");
}

TEST_F(Polygons, ThatAreNeitherPlaneNorConvexAreCutWhereTheyLookSimple) {
  std::vector<Point> concave = kComb;
  concave[3][2] = 1;
  const Surface s = read(off_of(concave, range(concave.size())), "a.off");
  EXPECT_EQ(s.facets.size(), kComb.size() - 2);
  EXPECT_EQ(bits(s.vertices), bits(concave));
  EXPECT_EQ(area_of(s), 2 * 14);
  EXPECT_NE(s.remarks[0].message.find("from the mean plane of their polygon"), std::string::npos);
  // Seen along z this one crosses itself, but not along y.
  const std::vector<Point> folded{{0, 0, 0},  {4, 0, 0},  {4, 2, 1}, {2, 1, 1.5},
                                  {1, -1, 2}, {3, -1, 3}, {0, 2, 3}};
  const Surface t = read(off_of(folded, range(folded.size())), "a.off");
  EXPECT_EQ(t.facets.size(), folded.size() - 2);
  EXPECT_EQ(sides_of(t.facets), sides_of(range(folded.size())));
  EXPECT_EQ(t.remarks[0].message.find("cross"), std::string::npos);
}

// A strip that winds round an axis three times crosses itself seen from any side; its shortest diagonals lead
// across the strip.
TEST_F(Polygons, ThatWindRoundAnAxisBecomeTrianglesOfLeastArea) {
  const std::size_t steps = 36;
  std::vector<Point> helix;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double turn = static_cast<double>(i) * 0.5235987755982988;
    helix.push_back({std::cos(turn), std::sin(turn), 0.1 * static_cast<double>(i)});
  }
  for (std::size_t i = steps + 1; i-- > 0;)
    helix.push_back({1.5 * helix[i][0], 1.5 * helix[i][1], helix[i][2] + 0.01});
  const Surface s = read(off_of(helix, range(helix.size())), "a.off");
  EXPECT_EQ(s.facets.size(), helix.size() - 2);
  EXPECT_EQ(sides_of(s.facets), sides_of(range(helix.size())));
  for (const Defect& defect : diagnose(s.view()))
    EXPECT_EQ(defect.kind, DefectKind::encloses_nothing) << defect.message;
}

// Whatever the corners are, triangles have the polygon's sides, and none depends on which corner is the
// first.
TEST_F(Polygons, OfRandomPlacesKeepTheirSides) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 300; ++trial) {
    const int range_of_places = trial % 2 == 0 ? 3 : 1000;  // a coarse grid makes places and lines coincide
    std::uniform_int_distribution<int> place(0, range_of_places);
    std::vector<Point> points;
    for (int i = 0; i < 4 + trial % 9; ++i)
      points.push_back({static_cast<double>(place(random)), static_cast<double>(place(random)),
                        trial % 3 == 0 ? 0 : static_cast<double>(place(random))});
    std::vector<Index> corners = range(points.size());
    const Surface s = read(off_of(points, corners), "a.off");
    EXPECT_EQ(places_of(sides_of(s.facets), points), places_of(sides_of(corners), points)) << text_of(points);
    std::rotate(corners.begin(), corners.begin() + 2, corners.end());
    const Surface turned = read(off_of(points, corners), "a.off");
    if (s.remarks.size() == 1 && s.remarks[0].message.find("cross") != std::string::npos) {
      EXPECT_EQ(turned.remarks[0].message, s.remarks[0].message) << text_of(points);
    }
  }
}

TEST_F(Polygons, OnALineBecomeTrianglesThatAreDegenerate) {
  const Surface s = read("OFF 4 1 0\n0 0 0\n3 0 0\n1 0 0\n2 0 0\n4 0 1 2 3\n", "a.off");
  EXPECT_EQ(s.facets.size(), 2u);
  const std::vector<Defect> defects = diagnose(s.view());
  EXPECT_EQ(std::count_if(defects.begin(), defects.end(),
                          [](const Defect& d) { return d.kind == DefectKind::degenerate_facet; }),
            2);
}

TEST_F(Polygons, ToleranceMustBeFinite) {
  for (const double tolerance : {-1.0, HUGE_VAL, std::nan("")})
    EXPECT_THROW(static_cast<void>(read(off_of(kCrossable, {0, 1, 2, 3}), "a.off", tolerance)),
                 std::invalid_argument);
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
  const std::vector<Index> corners = range(kComb.size());
  for (const std::string& file : {off_of(single, corners), six + "13 0 1 2 3 4 5 6 7 8 9 10 11 12\n"}) {
    const Surface read_back = read(file, "a.off");
    EXPECT_EQ(read_back.facets.size(), kComb.size() - 2);
    ASSERT_EQ(read_back.remarks.size(), 1u);  // and reported
    EXPECT_NE(read_back.remarks[0].message.find("from the mean plane"), std::string::npos);
  }
}

// Seen along z, two corners coincide.
TEST_F(Polygons, NearlyPlaneButFoldedBecomeTrianglesOfLeastArea) {
  const std::vector<Point> points{{0, 0, 0}, {2, 0, 0}, {2, 0, 1e-6}, {1, 0, 2e-6}, {0, 2, 0}};
  const Surface s = read(off_of(points, {0, 1, 2, 3, 4}), "a.off");
  EXPECT_EQ(s.facets.size(), 3u);
  EXPECT_EQ(sides_of(s.facets), sides_of(range(5)));
}

TEST_F(Polygons, RoundingAloneNeedsNoTolerance) {
  // Rotated by angles that are not doubles.
  const double c = std::cos(0.3), s = std::sin(0.3), d = std::cos(1.1), e = std::sin(1.1);
  std::vector<Point> points;
  for (const Point& p : kComb) {
    const double x = c * p[0] - s * p[1], y = s * p[0] + c * p[1];
    points.push_back({x + 100, d * y + 1000, e * y});
  }
  const std::vector<Index> corners = range(kComb.size());
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

TEST_F(Polygons, WithACornerThatIsNotFiniteAreDiagnosed) {
  const Surface s = read("OFF 4 1 0\n0 0 0\n2 0 0\n0.5 nan 0\n0 2 0\n4 0 1 2 3\n", "a.off");
  EXPECT_EQ(s.facets.size(), 2u);
  const std::vector<Defect> defects = diagnose(s.view());
  ASSERT_FALSE(defects.empty());
  EXPECT_EQ(defects[0].kind, DefectKind::non_finite_coordinate);
}

}  // namespace
}  // namespace holdfast::polygon_test
