// The pipeline from end to end, through the public header.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "api/scale.h"
#include "delaunay/box.h"
#include "holdfast/check.h"
#include "holdfast/holdfast.h"
#include "small_surfaces.h"
#include "unit/meshed.h"

namespace holdfast::api_test {
namespace {

using namespace testing;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Mesh, Tetrahedron) {
  Surface surface;
  surface.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  surface.facets = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  const Result result = mesh(surface.view());
  expect_done(surface, result);
  EXPECT_EQ(result.volume.tetrahedra.size(), 1u);
  EXPECT_EQ(result.volume.regions, std::vector<int>{1});
  EXPECT_EQ(result.volume.vertices.size(), 4u);
  const Report& report = result.report;
  EXPECT_EQ(report.input.vertices, 4u);
  EXPECT_EQ(report.input.segments, 6u);
  EXPECT_EQ(report.input.facets, 4u);
  EXPECT_EQ(report.input.components, 1u);
  EXPECT_TRUE(report.input.closed);
  EXPECT_EQ(report.input.dangling_facets, 0u);
  EXPECT_EQ(report.delaunay.segments, 0u);
  EXPECT_EQ(report.steiner_points, 0u);
  EXPECT_EQ(report.vertices, 4u);
  EXPECT_EQ(report.tetrahedra, 1u);
  EXPECT_EQ(report.regions, 1u);
  EXPECT_NEAR(report.elements.worst, std::sqrt(6.0) / 12 * std::sqrt(2.0) * (3 + std::sqrt(3.0)), 1e-12);
  EXPECT_LE(report.elements.target, report.elements.worst);
  EXPECT_GT(report.peak_memory_bytes, 0u);
  for (const char* key : {"validate", "delaunay", "flips", "partition", "classify", "suppress", "total"})
    EXPECT_TRUE(report.seconds.contains(key)) << key;
}

TEST(Mesh, BoxWithAndWithoutFlips) {
  const Surface surface = small::box();
  Options options;
  for (const bool flips : {true, false}) {
    options.flips = flips;
    const Result result = mesh(surface.view(), options);
    expect_done(surface, result);
    EXPECT_EQ(result.report.regions, 1u);
    if (!flips) {
      EXPECT_EQ(result.report.flips.facets, result.report.delaunay.facets);
      EXPECT_EQ(result.report.flips.segments, result.report.delaunay.segments);
    }
  }
}

TEST(Mesh, SteinerPointOfSchoenhardt) {
  const Surface surface = small::without_integer_points(0);
  Options options;
  for (const bool flips : {true, false}) {
    options.flips = flips;
    const Result result = mesh(surface.view(), options);
    expect_done(surface, result);
    EXPECT_GE(result.report.steiner_points, 1u);
    EXPECT_GE(result.report.forced_points, 1u);
    EXPECT_EQ(result.volume.vertices.size(), 6 + result.report.steiner_points);
  }
}

// Squares of a rotated plate, whose corners are coplanar up to rounding.
Surface turned_plate() {
  constexpr Index kSquares = 5, kSide = kSquares + 1;
  Surface surface;
  for (const double z : {0.0, 0.05})
    for (Index i = 0; i < kSide * kSide; ++i) {
      const Index row = i / kSide, column = i % kSide;
      const double x = row / 5.0, y = column / 5.0, c = std::cos(1), s = std::sin(1);
      surface.vertices.push_back({c * x - s * (c * y - s * z), s * x + c * (c * y - s * z), s * y + c * z});
    }
  const auto add_square = [&](Index a, Index b, Index c, Index d) {
    surface.facets.push_back({a, b, c});
    surface.facets.push_back({a, c, d});
  };
  const Index top = kSide * kSide;
  for (Index i = 0; i < kSquares; ++i) {
    for (Index j = 0; j < kSquares; ++j) {
      const Index k = i * kSide + j, right = k + kSide;
      add_square(k + 1, right + 1, right, k);
      add_square(top + k, top + right, top + right + 1, top + k + 1);
    }
    for (const auto& [from, step] : {std::pair{0u, kSide}, std::pair{kSide * kSquares, 1u}}) {
      const Index k = from + i * step, far = step == 1 ? k - kSide * kSquares : k + kSquares;
      add_square(k, k + step, top + k + step, top + k);
      add_square(far + step, far, top + far, top + far + step);
    }
  }
  return surface;
}

TEST(Mesh, WithoutPointsNoneAreAddedForFlatElements) {
  const Surface surface = turned_plate();
  double worst_with_points = 0;
  for (const bool add_points : {true, false}) {
    Options options;
    options.add_points = add_points;
    const Result result = mesh(surface.view(), options);
    expect_done(surface, result);
    EXPECT_EQ(result.report.forced_points, 0u);
    EXPECT_EQ(result.report.steiner_points > 0, add_points);
    EXPECT_EQ(result.report.optimised.points > 0, add_points);
    if (add_points)
      worst_with_points = result.report.elements.worst;
    else
      EXPECT_LT(10 * worst_with_points, result.report.elements.worst);
  }
}

// A ring of points between two far ones: a point does not improve its worst element.
TEST(Mesh, PointsThatBetterNothingGoAgain) {
  constexpr Index kRing = 300;
  Surface surface;
  for (Index k = 0; k < kRing; ++k) {
    const double angle = 2 * std::numbers::pi * k / kRing;
    surface.vertices.push_back({std::cos(angle), std::sin(angle), 0});
    surface.facets.push_back({k, (k + 1) % kRing, kRing});
    surface.facets.push_back({(k + 1) % kRing, k, kRing + 1});
  }
  surface.vertices.push_back({0, 0, 1e4});
  surface.vertices.push_back({0, 0, -1e4});
  const Result result = mesh(surface.view(), {});
  expect_done(surface, result);
  EXPECT_EQ(result.report.steiner_points, 0u);
  EXPECT_EQ(result.report.optimised.points, 0u);
}

// So many triangles that two threads list its elements and its segments at the same time.
TEST(Mesh, IndexOutOfRangeIsToldOnTwoThreads) {
  constexpr Index kSide = 80;
  Surface surface;
  for (Index k = 0; k < (kSide + 1) * (kSide + 1); ++k)
    surface.vertices.push_back({double(k / (kSide + 1)), double(k % (kSide + 1)), 0});
  for (Index k = 0; k < kSide * (kSide + 1); ++k) {
    if (k % (kSide + 1) == kSide) continue;
    surface.facets.push_back({k, k + 1, k + kSide + 2});
    surface.facets.push_back({k, k + kSide + 2, k + kSide + 1});
  }
  surface.facets.back()[2] = 1'000'000;
  Options options;
  options.threads = 2;
  const Result result = mesh(surface.view(), options);
  EXPECT_EQ(result.outcome, Outcome::invalid_input);
  ASSERT_EQ(result.defects.size(), 1u);
  EXPECT_EQ(result.defects[0].kind, DefectKind::index_out_of_range);
  EXPECT_EQ(result.defects[0].facets, std::vector<Index>{2 * kSide * kSide - 1});
}

TEST(Mesh, NestedBoxesAreTwoRegions) {
  const Surface surface = small::nested(true);
  const Result result = mesh(surface.view());
  expect_done(surface, result);
  EXPECT_EQ(ids(result.volume), (std::set<int>{1, 2}));
  EXPECT_EQ(result.report.regions, 2u);
}

TEST(Mesh, TellsTheRegionsOnBothSidesOfAFacet) {
  const Result box_result = mesh(small::box());
  ASSERT_EQ(box_result.facet_regions.size(), 12u);
  for (const FacetRegions& regions : box_result.facet_regions)
    EXPECT_EQ(regions, (FacetRegions{std::nullopt, 1}));  // its facets face outwards
  Surface walls = small::touching();
  small::add_triangle(walls, {0.3, 0.3, 0.4}, {0.7, 0.3, 0.5}, {0.4, 0.7, 0.6});
  Options box;
  box.keep = Keep::box;
  for (const Surface& surface : {walls, small::nested(true), small::nested(false)})
    for (const Options& options : {Options{}, box}) {
      const Result result = mesh(surface.view(), options);
      ASSERT_EQ(result.outcome, Outcome::done);
      EXPECT_EQ(result.facet_regions, sides(result.volume));
    }
}

TEST(Mesh, CavityStaysEmpty) {
  const Surface surface = small::nested(false);
  const Result result = mesh(surface.view());
  expect_done(surface, result);
  EXPECT_EQ(ids(result.volume), std::set<int>{1});
}

TEST(Mesh, HolesAndRegions) {
  const Surface surface = small::nested(true);
  Options options;
  options.holes = {{1.5, 1.5, 1.5}};
  options.regions = {{{0.5, 0.5, 0.5}, 42}};
  const Result result = mesh(surface.view(), options);
  expect_done(surface, result);
  EXPECT_EQ(ids(result.volume), std::set<int>{42});
}

TEST(Mesh, OutsideOfABoxIsRegionZero) {
  Surface surface = small::open_box();
  Options options;
  options.keep = Keep::box;
  options.box_margin = 0.25;
  const Result result = mesh(surface.view(), options);
  CheckOptions check_options;
  check_options.box = true;
  expect_done(surface, result, check_options);
  EXPECT_EQ(ids(result.volume), std::set<int>{0});
  EXPECT_EQ(result.volume.vertices.size(), 16 + result.report.steiner_points);
  for (const double x : {-0.25, 1.25}) {
    const auto& v = result.volume.vertices;
    EXPECT_TRUE(std::find(v.begin(), v.end(), Point{x, x, x}) != v.end());
  }
}

TEST(Mesh, BoxWithoutItsOutside) {
  const Surface surface = small::box();
  Options options;
  options.keep = Keep::box;
  options.holes = {{1.0625, 0.5, 0.5}};
  const Result result = mesh(surface.view(), options);
  expect_done(surface, result);
  EXPECT_EQ(ids(result.volume), std::set<int>{1});
  EXPECT_EQ(result.volume.vertices.size(), 8 + result.report.steiner_points);
  options.holes = {{0.5, 0.5, 0.5}};
  const Result around = mesh(surface.view(), options);
  CheckOptions check_options;
  check_options.box = true;
  expect_done(surface, around, check_options);
  EXPECT_EQ(ids(around.volume), std::set<int>{0});
}

TEST(Mesh, FlatInputInABox) {
  Surface surface;
  small::add_triangle(surface, {0, 0, 5}, {4, 0, 5}, {0, 4, 5});
  surface.vertices.push_back({1e16, 0, 5});
  Options options;
  options.keep = Keep::box;
  CheckOptions check_options;
  check_options.box = true;
  expect_done(surface, mesh(surface.view(), options), check_options);
  surface = {};
  surface.vertices = {{3, 4, 5}};  // no extent at all
  expect_done(surface, mesh(surface.view(), options), check_options);
}

TEST(Mesh, WhatHangsInsideStays) {
  Surface surface = small::box();
  small::add_triangle(surface, {0.3, 0.3, 0.4}, {0.7, 0.3, 0.5}, {0.4, 0.7, 0.6});
  small::add_segment(surface, {0.1, 0.2, 0.3}, {0.9, 0.2, 0.2});
  surface.vertices.push_back({0.8, 0.8, 0.85});
  const Result result = mesh(surface.view());
  expect_done(surface, result);
  EXPECT_EQ(result.report.input.dangling_facets, 1u);
  EXPECT_EQ(result.volume.facets.size(), 13u);
  EXPECT_EQ(result.volume.segments, surface.segments);
}

TEST(Mesh, KeepsMarkersAndMergesRepeatedSegments) {
  Surface surface = small::box();
  for (int f = 0; f < 12; ++f) surface.facet_markers.push_back(100 - f);
  surface.segments = {{0, 1}, {1, 0}, {0, 2}, {0, 1}};
  surface.segment_markers = {7, 7, -3, 7};
  for (int v = 0; v < 8; ++v) surface.vertex_markers.push_back(20 - 3 * v);
  Options options;
  options.sizes = Sizes{.size = 0.4};
  const Result result = mesh(surface.view(), options);
  expect_done(surface, result);
  EXPECT_EQ(result.volume.facets, surface.facets);
  EXPECT_EQ(result.volume.facet_markers, surface.facet_markers);
  EXPECT_EQ(result.volume.segments, (std::vector<Segment>{{0, 1}, {0, 2}}));
  EXPECT_EQ(result.volume.segment_markers, (std::vector<int>{7, -3}));
  ASSERT_GT(result.volume.vertices.size(), 8u);
  std::vector<int> expected = surface.vertex_markers;
  expected.resize(result.volume.vertices.size(), 0);
  EXPECT_EQ(result.volume.vertex_markers, expected);
}

TEST(Mesh, KeepsTheSignOfZero) {
  Surface surface = small::box();
  surface.vertices[0] = {-0.0, 0.0, -0.0};
  surface.vertices[6] = {-0.0, 1.0, 1.0};
  const Result result = mesh(surface.view());
  expect_done(surface, result);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_TRUE(same_bits(result.volume.vertices[i], surface.vertices[i])) << i;
}

TEST(Mesh, SameResultForSameInput) {
  const Surface surface = bumpy(8, 12);
  const Result first = mesh(surface.view());
  expect_done(surface, first);
  const Result second = mesh(surface.view());
  EXPECT_TRUE(same(first.volume, second.volume));
}

TEST(Mesh, ExtremeMagnitudes) {
  const Surface usual = small::without_integer_points(0);
  const Result expected = mesh(usual.view());
  for (const int k : {-1060, -900, -700, -300, 300, 700, 1000, 1020}) {
    Surface surface = usual;
    for (Point& p : surface.vertices) p = scaled(p, k);
    const Result result = mesh(surface.view());
    EXPECT_EQ(result.outcome, Outcome::done) << "2^" << k << ": " << result.message;
    EXPECT_EQ(broken_rules(surface, result), "") << "2^" << k;
    if (k < -800) continue;  // not scaled: see choose_scale
    ASSERT_EQ(result.volume.tetrahedra, expected.volume.tetrahedra) << "2^" << k;
    for (std::size_t i = 0; i < expected.volume.vertices.size(); ++i)
      EXPECT_EQ(result.volume.vertices[i], scaled(expected.volume.vertices[i], k));
    EXPECT_NEAR(result.report.elements.worst, expected.report.elements.worst, 1e-9);
  }
}

TEST(Mesh, MagnitudesThatNoScaleBringsTogether) {
  Surface surface = small::box({0, 0, 0}, {1e300, 1e300, 1e-300});
  expect_done(surface, mesh(surface.view()));
}

TEST(Mesh, NotRepresentable) {
  const Surface surface = small::without_integer_points(0x1p52);
  const Result result = mesh(surface.view());
  EXPECT_EQ(result.outcome, Outcome::not_representable);
  EXPECT_FALSE(result.message.empty());
  ASSERT_FALSE(result.exact_vertices.empty());
  EXPECT_EQ(result.report.unrounded_points, result.exact_vertices.size());
  EXPECT_GE(result.volume.tetrahedra.size(), 8u);
  for (const ExactVertex& vertex : result.exact_vertices) {
    EXPECT_GE(vertex.vertex, 6u);
    EXPECT_LT(vertex.vertex, result.volume.vertices.size());
    for (const std::string& x : vertex.coordinates) EXPECT_NE(x.find("*2^"), std::string::npos) << x;
  }
}

TEST(Mesh, TheSeedDecidesAndNothingElseDoes) {
  std::set<std::vector<Tetrahedron>> meshes;
  Surface surface = small::box({0, 0, 0}, {4, 4, 4});
  for (int k = 0; k < 27; ++k)  // any eight of a cell are cospherical
    surface.vertices.push_back({1.0 + k % 3, 1.0 + k / 3 % 3, 1.0 + k / 9});
  for (const bool flips : {true, false}) {
    meshes.clear();
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
      Options options;
      options.flips = flips;
      options.seed = seed;
      const Result once = mesh(surface.view(), options), again = mesh(surface.view(), options);
      expect_done(surface, once);
      EXPECT_EQ(once.volume.tetrahedra, again.volume.tetrahedra);
      EXPECT_EQ(once.volume.vertices, again.volume.vertices);
      meshes.insert(once.volume.tetrahedra);
    }
    EXPECT_GT(meshes.size(), 1u);
  }
}

TEST(Names, OfStagesAndVersion) {
  EXPECT_STREQ(name(Stage::validate), "validate");
  EXPECT_STREQ(name(Stage::suppress), "suppress");
  EXPECT_STREQ(name(Stage::optimise), "optimise");
  EXPECT_NE(std::string(version()).find('.'), std::string::npos);
}

TEST(Box, HoldsEverythingStrictlyInside) {
  const auto strictly_inside = [](const std::vector<Point>& vertices, double margin) {
    const auto corners = box_corners(vertices, margin);
    for (const Point& p : vertices)
      for (std::size_t i = 0; i < 3; ++i)
        if (!(corners[0][i] < p[i] && p[i] < corners[7][i])) return false;
    return true;
  };
  EXPECT_TRUE(strictly_inside({{0, 0, 0}, {1, 2, 3}}, 0.5));
  EXPECT_TRUE(strictly_inside({{1e16, 1e16, 1e16}, {1e16, 1e16, 1e16 + 2}}, 0.1));
  EXPECT_TRUE(strictly_inside({{0, 0, 0}, {1, 1, 1}}, 1e-300));
  EXPECT_TRUE(strictly_inside({{0, 0, 0}}, 0.1));
  EXPECT_TRUE(strictly_inside({{0, 0, 0}, {5e-324, 0, 0}}, 0.1));
  EXPECT_TRUE(strictly_inside({}, 0.1));
}

TEST(Scale, IsUsedWhereItLosesNothing) {
  const auto of = [](double x, double y) {
    const std::vector<Point> vertices{{x, 0, 0}, {0, y, -0.0}};
    return choose_scale(vertices);
  };
  EXPECT_EQ(of(1, 1e-300), 0);
  EXPECT_EQ(of(0x1p64, 1), 0);
  EXPECT_EQ(of(0x1p65, 1), -65);
  EXPECT_EQ(of(0x1p500, 3), -500);
  EXPECT_EQ(of(0x1p1000, 1), -914);  // 160 bits below 1 are left
  EXPECT_EQ(of(0x1p1000, 0x1p86), -1000);
  EXPECT_EQ(of(0x1p1000, 0x1p-914), 0);
  EXPECT_EQ(of(0x1p1000, 0x1p-1074), 0);
  EXPECT_EQ(of(0x1p-300, 0x1p-1074), 300);
  EXPECT_EQ(of(0x1p-774, 0), 774);
  EXPECT_EQ(of(0x1p-1000, 0x1p-1074), 1000);
  EXPECT_EQ(of(0x1p-1074, 0), 1074);
  EXPECT_EQ(of(0, 0), 0);
  EXPECT_EQ(choose_scale({}), 0);
}

}  // namespace
}  // namespace holdfast::api_test
