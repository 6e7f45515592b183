// The plane between exact points: what holds for doubles holds for quotients that are not doubles, and for
// points that share one double.
#include "plane/exact_plane.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <map>
#include <optional>
#include <set>

#include "exact/space_point.h"
#include "holdfast/names.h"
#include "plane_inputs.h"

namespace holdfast::exact_plane_test {
namespace {

using boost::multiprecision::cpp_rational;
using exact::BigInt;
using exact::RationalPoint;
using plane::Corners3;
using plane::ExactPlane;
using plane::Points;
using plane::Vertex;
using testing::kWays;
using testing::Way;

PlaneOptions options_of(const Way& way, bool delaunay) {
  PlaneOptions options;
  options.method = way.method;
  options.ears = way.ears;
  options.partition_first = way.partition_first;
  options.delaunay = delaunay;
  return options;
}

/// Calls `visit` with the options of every method, with and without Delaunay.
template <typename Visit>
void each_way(Visit&& visit) {
  for (const Way& way : kWays)
    for (const bool delaunay : {false, true}) {
      SCOPED_TRACE(::testing::Message()
                   << name(way.method) << ' ' << name(way.ears)
                   << (way.partition_first ? " partition first" : "") << (delaunay ? ", Delaunay" : ""));
      visit(options_of(way, delaunay));
    }
}

using Found = std::optional<std::vector<Corners3>>;
Found solve(const ExactPlane& plane, const PlaneOptions& options, PlaneReport& report) {
  return plane::triangulate(plane, options, report, [](double) {});
}
Found solve(const ExactPlane& plane, const PlaneOptions& options) {
  PlaneReport report;
  return solve(plane, options, report);
}

/// Maps (x, y) to (x / across, y / up); if `together` is not 0, to one plus 2^-together of that.
struct Map {
  int across, up;
  unsigned together = 0;

  [[nodiscard]] RationalPoint operator()(const PlanePoint& p) const {
    const RationalPoint r = exact::rational_point(p.data());
    const BigInt w = (r.w * across * up) << together, one = together > 0 ? w : BigInt(0);
    return {r.x * up + one, r.y * across + one, w};
  }
  [[nodiscard]] ExactPlane operator()(const Plane& plane) const {
    ExactPlane mapped;
    for (const PlanePoint& p : plane.points) mapped.points.add((*this)(p));
    for (const PlanePoint& p : plane.holes) mapped.holes.add((*this)(p));
    mapped.segments = plane.segments;
    return mapped;
  }
  /// The factor by which areas shrink.
  [[nodiscard]] cpp_rational share() const {
    return cpp_rational(BigInt(1), BigInt(across * up) << (2 * together));
  }
};
constexpr Map kThirds{3, 3}, kQuotients{3, 7}, kAtOneDouble{3, 7, 1200};

cpp_rational double_area(const Points& points, const std::vector<Corners3>& triangles) {
  cpp_rational sum = 0;
  for (const Corners3& t : triangles) {
    std::array<std::array<cpp_rational, 2>, 3> at;
    for (std::size_t i = 0; i < 3; ++i) {
      const RationalPoint p = points.rational(t[i]);
      at[i] = {cpp_rational(p.x, p.w), cpp_rational(p.y, p.w)};
    }
    sum += (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) - (at[1][1] - at[0][1]) * (at[2][0] - at[0][0]);
  }
  return sum;
}

cpp_rational double_area(const PlaneMesh& mesh) {
  Points points;
  for (const PlanePoint& p : mesh.points) points.add(p);
  return double_area(points, mesh.triangles);
}

using Sides = std::map<Segment, Vertex>;  // with the corner on the left of each side
Sides sides_of(const std::vector<Corners3>& triangles) {
  Sides sides;
  for (const Corners3& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_TRUE(sides.insert({{t[i], t[(i + 1) % 3]}, t[(i + 2) % 3]}).second) << "triangles overlap";
  return sides;
}

/// The segments that are edges of some triangle.
std::set<Segment> laid(const std::vector<Segment>& segments, const std::vector<Corners3>& triangles) {
  const Sides sides = sides_of(triangles);
  std::set<Segment> found;
  for (const Segment& s : segments)
    if (sides.contains(s) || sides.contains({s[1], s[0]})) found.insert(s);
  return found;
}

/// Positive triangles whose border consists of segments, and so do edges that are not Delaunay if they must
/// be. Uses only numbers, so that the filters under test are not involved.
void expect_sound(const ExactPlane& plane, const std::vector<Corners3>& triangles, bool delaunay) {
  std::vector<RationalPoint> at;
  for (Vertex v = 0; v < plane.points.size(); ++v) at.push_back(plane.points.rational(v));
  std::set<Segment> segments;
  for (const auto& [a, b] : plane.segments) segments.insert({std::min(a, b), std::max(a, b)});
  for (const Corners3& t : triangles) EXPECT_GT(exact::orient2d(at[t[0]], at[t[1]], at[t[2]]), 0);
  const Sides sides = sides_of(triangles);
  for (const auto& [side, corner] : sides) {
    const auto [a, b] = side;
    if (segments.contains({std::min(a, b), std::max(a, b)})) continue;
    const auto other = sides.find({b, a});
    EXPECT_TRUE(other != sides.end() || segments.empty()) << "a border edge is no segment";
    if (delaunay && other != sides.end()) {
      EXPECT_LE(exact::incircle(at[a], at[b], at[corner], at[other->second]), 0);
    }
  }
}

/// Compares the triangles of the doubles' images, by every method, with those of the doubles.
void expect_alike(const Plane& plane, const Map& map) {
  const ExactPlane mapped = map(plane);
  each_way([&](const PlaneOptions& options) {
    const PlaneMesh expected = triangulate(plane, options).mesh;
    PlaneReport report;
    const Found found = solve(mapped, options, report);
    ASSERT_TRUE(found);
    ASSERT_EQ(found->size(), expected.triangles.size());
    expect_sound(mapped, *found, options.delaunay);
    EXPECT_EQ(double_area(mapped.points, *found), double_area(expected) * map.share());
    EXPECT_EQ(laid(plane.segments, *found), laid(plane.segments, expected.triangles));
    if (options.method == PlaneMethod::ears) {
      EXPECT_GE(report.ears + report.joined, found->size());
    } else if (options.method == PlaneMethod::partition) {
      EXPECT_GE(report.partition_points, report.missing_segments);
    } else {
      EXPECT_GE(report.swaps, report.missing_segments);
    }
  });
}

class ExactPlanes : public ::testing::TestWithParam<int> {};

TEST_P(ExactPlanes, AreTriangulatedAsDoublesAre) {
  constexpr int kEach = 8;
  for (int k = 0; k < kEach; ++k) {
    const auto seed = static_cast<std::uint64_t>(GetParam() * kEach + k + 1);
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    const Plane plane = testing::random_plane(seed, 40);
    for (const Map& map : {kThirds, kQuotients, kAtOneDouble}) {
      SCOPED_TRACE(::testing::Message() << map.across << ' ' << map.up << ' ' << map.together);
      expect_alike(plane, map);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ExactPlanes, ::testing::Range(0, 6));

/// The intersection of three planes through points of a grid, seen along an axis.
RationalPoint common_point(numbers::Random& random) {
  const auto whole = [&] { return static_cast<double>(numbers::below(50, random)); };
  const auto any_plane = [&] {
    std::array<Point, 3> p;
    for (Point& corner : p) corner = {whole(), whole(), whole()};
    return exact::plane_through(p[0].data(), p[1].data(), p[2].data());
  };
  for (;;) {
    const exact::SpacePlane p = any_plane(), q = any_plane(), r = any_plane();
    if (p.a * (q.b * r.c - q.c * r.b) - p.b * (q.a * r.c - q.c * r.a) + p.c * (q.a * r.b - q.b * r.a) != 0)
      return exact::projected(exact::crossing(p, q, r), 2);
  }
}

/// Some such points, and segments that only meet in common ends.
ExactPlane random_exact_plane(std::uint64_t seed) {
  numbers::Random random(seed);
  ExactPlane plane;
  const std::size_t count = 5 + numbers::below(40, random);
  Points& points = plane.points;
  while (points.size() < count) {
    points.add(common_point(random));
    const auto last = static_cast<Vertex>(points.size() - 1);
    Vertex v = 0;
    while (points.compare(v, last) != 0) ++v;
    if (v < last) points.shrink(last);
  }
  const auto fits = [&](Vertex a, Vertex b) {
    for (Vertex v = 0; v < count; ++v)
      if (v != a && v != b && points.orient(a, b, v) == 0 && points.between(a, b, v)) return false;
    return std::all_of(plane.segments.begin(), plane.segments.end(), [&](const Segment& s) {
      if ((s[0] == a && s[1] == b) || (s[0] == b && s[1] == a)) return false;
      return points.orient(a, b, s[0]) * points.orient(a, b, s[1]) >= 0 ||
             points.orient(s[0], s[1], a) * points.orient(s[0], s[1], b) >= 0;
    });
  };
  for (std::size_t tries = 0; tries < 8 * count; ++tries) {
    const auto a = static_cast<Vertex>(numbers::below(count, random)),
               b = static_cast<Vertex>(numbers::below(count, random));
    if (a != b && fits(a, b)) plane.segments.push_back({a, b});
  }
  return plane;
}

TEST(ExactPlane, KeepsSegmentsBetweenPointsOfThreePlanes) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    const ExactPlane plane = random_exact_plane(seed);
    std::optional<std::size_t> count;
    std::optional<cpp_rational> area;
    std::optional<std::set<Segment>> segments;
    each_way([&](const PlaneOptions& options) {
      const Found found = solve(plane, options);
      ASSERT_TRUE(found);
      expect_sound(plane, *found, options.delaunay);
      const cpp_rational now = double_area(plane.points, *found);
      const std::set<Segment> edges = laid(plane.segments, *found);
      EXPECT_EQ(found->size(), count.value_or(found->size()));
      EXPECT_EQ(now, area.value_or(now));
      EXPECT_EQ(edges, segments.value_or(edges));
      count = found->size();
      area = now;
      segments = edges;
    });
    EXPECT_GT(count, 0u);
  }
}

/// Segments along closed outlines through whole numbers; each place occurs once.
Plane outlines_of(const std::vector<std::vector<PlanePoint>>& outlines) {
  Plane plane;
  std::map<PlanePoint, Index> number;
  const auto at = [&](const PlanePoint& p) {
    const auto [it, fresh] = number.insert({p, static_cast<Index>(plane.points.size())});
    if (fresh) plane.points.push_back(p);
    return it->second;
  };
  for (const std::vector<PlanePoint>& outline : outlines)
    for (std::size_t i = 0; i < outline.size(); ++i)
      plane.segments.push_back({at(outline[i]), at(outline[(i + 1) % outline.size()])});
  return plane;
}

std::vector<PlanePoint> rectangle(int x, int y, int width, int height) {
  std::vector<PlanePoint> outline;
  const auto add = [&](int i, int j) {
    outline.push_back({static_cast<double>(x + i), static_cast<double>(y + j)});
  };
  for (int i = 0; i < width; ++i) add(i, 0);
  for (int j = 0; j < height; ++j) add(width, j);
  for (int i = 0; i < width; ++i) add(width - i, height);
  for (int j = 0; j < height; ++j) add(0, height - j);
  return outline;
}

TEST(ExactPlane, HasRunsOfPointsOnALine) {
  Plane plane = outlines_of({rectangle(0, 0, 9, 6), rectangle(2, 1, 4, 3)});
  plane.holes = {{3, 2}};
  for (const Map& map : {kThirds, kQuotients, kAtOneDouble}) expect_alike(plane, map);
}

TEST(ExactPlane, HasHolesThatTouch) {
  // The first one has a common corner with the outline, the second one with the first.
  Plane plane =
      outlines_of({{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, {{0, 0}, {4, 3}, {3, 3}}, {{4, 3}, {5, 6}, {4, 4}}});
  plane.holes = {{3, 2.5}, {4.25, 4}};
  for (const Map& map : {kThirds, kQuotients, kAtOneDouble}) expect_alike(plane, map);
  each_way([&](const PlaneOptions& options) {
    EXPECT_EQ(double_area(triangulate(plane, options).mesh), cpp_rational(128 - 3 - 1));
  });
}

TEST(ExactPlane, IsRefusedWhereDoublesAre) {
  std::size_t spoilt = 0;
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    Plane plane = testing::random_plane(seed, 30);
    numbers::Random random(seed);
    const std::optional<testing::Spoilt> way = testing::spoil(plane, random);
    if (!way || way->kind == DefectKind::non_finite_coordinate) continue;
    ++spoilt;
    for (const Map& map : {kQuotients, kAtOneDouble}) {
      const ExactPlane mapped = map(plane);
      each_way([&](const PlaneOptions& options) { EXPECT_FALSE(solve(mapped, options)) << name(way->kind); });
    }
  }
  EXPECT_GT(spoilt, 30u);
}

TEST(ExactPlane, KnowsAPlaceByAnyOfItsFractions) {
  ExactPlane plane;
  for (const RationalPoint& p : {RationalPoint{1, 1, 3}, {2, 1, 3}, {1, 2, 3}, {2, 2, 6}})
    plane.points.add(p);
  each_way([&](const PlaneOptions& options) { EXPECT_FALSE(solve(plane, options)); });
}

TEST(ExactPlane, HasNoTrianglesOnOneLine) {
  ExactPlane plane;
  for (int i = 0; i < 5; ++i) plane.points.add({BigInt(i), BigInt(2 * i + 1), BigInt(7)});
  plane.segments = {{0, 1}, {1, 2}};
  each_way([&](const PlaneOptions& options) { EXPECT_EQ(solve(plane, options), std::vector<Corners3>{}); });
  plane.segments.push_back({0, 4});  // over points
  each_way([&](const PlaneOptions& options) { EXPECT_FALSE(solve(plane, options)); });
}

TEST(ExactPlane, OfDoublesIsWhatTheirsIs) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Plane plane = testing::random_plane(seed);
    ExactPlane same;
    for (const PlanePoint& p : plane.points) same.points.add(p);
    same.segments = plane.segments;
    each_way([&](const PlaneOptions& options) {
      EXPECT_EQ(solve(same, options), triangulate(plane, options).mesh.triangles);
    });
  }
}

TEST(ExactPlane, GivesSinglePolygonsTheirTriangles) {
  // A comb, with a bridge to a hole that the walk passes twice.
  const std::vector<PlanePoint> comb{{0, 0}, {6, 0}, {6, 3}, {5, 3}, {5, 1}, {4, 1},
                                     {4, 3}, {0, 3}, {1, 1}, {1, 2}, {2, 2}};
  const std::vector<Vertex> walk{0, 1, 2, 3, 4, 5, 6, 7, 0, 8, 9, 10, 8};
  const auto poll = [](double) {};
  const auto expected = plane::triangles_of_walk(comb, walk, poll);
  ASSERT_TRUE(expected);
  for (const Map& map : {kThirds, Map{3, 3, 1200}}) {
    Points points;
    for (const PlanePoint& p : comb) points.add(map(p));
    const auto found = plane::triangles_of_walk(points, walk, poll);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->size(), expected->size());
    EXPECT_EQ(double_area(points, *found), map.share() * (2 * (18 - 2) - 1));
  }
}

}  // namespace
}  // namespace holdfast::exact_plane_test
