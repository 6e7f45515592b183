// Vertices with identical coordinates are one vertex, and all messages name those of the caller.
#include "surface/places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "holdfast/check.h"
#include "holdfast/holdfast.h"
#include "holdfast/untangle.h"
#include "small_surfaces.h"
#include "split_vertices.h"
#include "unit/check_cases.h"

namespace holdfast::places_test {
namespace {

using Indices = std::vector<Index>;
using Map = std::vector<std::int64_t>;
using small::box;
using small::surface_of;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The box's corners after `front`.
Surface behind(const Surface& whole, const std::vector<Point>& front) {
  Surface surface = whole;
  surface.vertices.insert(surface.vertices.begin(), front.begin(), front.end());
  for (Triangle& f : surface.facets)
    for (Index& v : f) v += static_cast<Index>(front.size());
  return surface;
}

std::string broken_rules(const Surface& surface, const Result& result) {
  std::string text;
  for (const Rule& rule : check(surface.view(), result.volume).rules)
    if (!rule.holds) text += rule.name + ": " + rule.detail + "\n";
  return text;
}

std::string message_of_only(const std::vector<Defect>& defects) {
  EXPECT_EQ(defects.size(), 1u);
  return defects.empty() ? "" : defects[0].message;
}

// --- which vertices are one

TEST(Places, DistinctVerticesDoNotChange) {
  const Surface s = box();
  EXPECT_TRUE(vertex_map(s.view()).empty());
  const Result result = mesh(s.view());
  EXPECT_TRUE(result.vertex_map.empty());
  Map origin{0, 1, 2, 3, 4, 5, 6, 7};
  origin.resize(result.volume.vertices.size(), -1);
  EXPECT_EQ(result.volume.input_vertices, origin);
}

TEST(Places, ZerosOfBothSignsAreOnePlaceWithTheBitsOfTheFirst) {
  Surface s = box();
  s.vertices[0] = {-0.0, 0, -0.0};
  s.vertices.push_back({0, -0.0, 0});
  s.facets[0][0] = 8;  // of facet (0, 2, 3)
  ASSERT_TRUE(diagnose(s.view()).empty());
  const Result result = mesh(s.view());
  ASSERT_EQ(result.outcome, Outcome::done);
  EXPECT_EQ(result.vertex_map, (Map{0, 1, 2, 3, 4, 5, 6, 7, 0}));
  EXPECT_TRUE(std::signbit(result.volume.vertices[0][0]));
  EXPECT_FALSE(std::signbit(result.volume.vertices[0][1]));
  EXPECT_EQ(broken_rules(s, result), "");
}

TEST(Places, NeighbouringDoublesAreTwoPlaces) {
  const Point p{1, 2, 3};
  for (std::size_t k = 0; k < 3; ++k) {
    Point q = p;
    q[k] = std::nextafter(q[k], 4);
    EXPECT_EQ(first_at_places(std::vector<Point>{p, q, p}), (Indices{0, 1, 0}));
  }
}

TEST(Places, OfVerySmallAndLargeCoordinates) {
  const double least = std::numeric_limits<double>::denorm_min(), most = std::numeric_limits<double>::max();
  EXPECT_EQ(first_at_places(std::vector<Point>{{least, 0, most}, {-least, 0, most}, {least, -0.0, most}}),
            (Indices{0, 1, 0}));
}

TEST(Places, UnusedVerticesThatAreRepeatedOrNotFiniteAreLeftOut) {
  // Two copies of corner 5 first, and after them a point inside, twice, and points that are not finite.
  Surface s = behind(box(), {{1, 0, 1}, {1, 0, 1}});
  for (const Point& p :
       {Point{0.5, 0.5, 0.5}, Point{kNan, 0, 0}, Point{0.5, 0.5, 0.5}, Point{0, 0, kInfinity}})
    s.vertices.push_back(p);
  EXPECT_TRUE(diagnose(s.view()).empty());
  const Result result = mesh(s.view());
  ASSERT_EQ(result.outcome, Outcome::done) << result.message;
  EXPECT_EQ(result.vertex_map, (Map{-1, -1, 0, 1, 2, 3, 4, 5, 6, 7, 8, -1, -1, -1}));
  EXPECT_EQ(result.volume.input_vertices[0], 2);
  EXPECT_EQ(result.volume.input_vertices[8], 10);
  EXPECT_EQ(result.volume.vertices[8], (Point{0.5, 0.5, 0.5}));
  EXPECT_EQ(result.report.input.vertices, 9u);
  EXPECT_EQ(result.report.input.merged_vertices, 0u);
  EXPECT_EQ(result.report.input.left_out_vertices, 5u);
  EXPECT_EQ(broken_rules(s, result), "");
}

TEST(Places, ATriangleSoupIsMeshedAsASurface) {
  Surface whole = small::touching();
  whole.facet_markers.resize(whole.facets.size());
  for (std::size_t f = 0; f < whole.facets.size(); ++f) whole.facet_markers[f] = static_cast<int>(f);
  const Surface soup = split::soup(whole);
  const Result result = mesh(soup.view());
  ASSERT_EQ(result.outcome, Outcome::done) << result.message;
  EXPECT_EQ(result.report.input.vertices, 12u);
  EXPECT_EQ(result.report.input.merged_vertices, 66u - 12u);
  EXPECT_EQ(result.report.regions, 2u);
  EXPECT_EQ(result.volume.facet_markers, whole.facet_markers);
  EXPECT_EQ(broken_rules(soup, result), "");
  for (std::size_t v = 0; v < soup.vertices.size(); ++v)
    EXPECT_EQ(result.volume.vertices[static_cast<std::size_t>(result.vertex_map[v])], soup.vertices[v]);
}

TEST(Places, TheSameOnAnyNumberOfThreads) {
  const Surface soup = split::soup(small::nested(true));
  Options options;
  options.keep = Keep::bounded;
  const Result one = mesh(soup.view(), options);
  options.threads = 4;
  const Result four = mesh(soup.view(), options);
  EXPECT_EQ(one.volume.tetrahedra, four.volume.tetrahedra);
  EXPECT_EQ(one.vertex_map, four.vertex_map);
}

TEST(Places, TheLeastOfTheSizesCounts) {
  const Surface soup = split::soup(box({0, 0, 0}, {8, 8, 8}));
  Options options;
  options.sizes = Sizes{.gradation = 0.2};
  options.sizes->vertex_sizes.assign(soup.vertices.size(), 6);
  const std::size_t coarse = mesh(soup.view(), options).report.field.points;
  // One of the vertices at a corner; that of least size is not the first.
  const auto last = std::find(soup.vertices.rbegin(), soup.vertices.rend(), Point{0, 0, 0});
  options.sizes->vertex_sizes[static_cast<std::size_t>(soup.vertices.rend() - last) - 1] = 0.5;
  EXPECT_GT(mesh(soup.view(), options).report.field.points, 4 * coarse + 4);
}

TEST(Places, TheStateAfterValidationHasEachPlaceOnce) {
  const Surface soup = split::soup(box());
  Options options;
  options.stop_after = Stage::validate;
  const Result result = mesh(soup.view(), options);
  EXPECT_EQ(result.volume.vertices.size(), 8u);
  EXPECT_EQ(result.volume.input_vertices.size(), 8u);
  EXPECT_EQ(result.vertex_map.size(), soup.vertices.size());
}

// --- messages

TEST(Places, FacetsThatBecomeOneAreRepeated) {
  Surface s = box();
  for (const Index v : s.facets[3]) s.vertices.push_back(Point(s.vertices[v]));
  s.facets.push_back({9, 8, 10});
  for (const std::vector<Defect>& defects : {diagnose(s.view()), mesh(s.view()).defects}) {
    ASSERT_EQ(defects.size(), 1u);
    EXPECT_EQ(defects[0].kind, DefectKind::repeated_facet);
    EXPECT_EQ(defects[0].facets, (Indices{3, 12}));
  }
}

TEST(Places, FacetsAndSegmentsThatCollapseAreDegenerate) {
  const Surface s =
      surface_of({{0, 0, 0}, {1, 0, 0}, {2, 2, 2}, {1, -0.0, 0}}, {{0, 3, 1}, {0, 1, 2}}, {{3, 1}});
  const std::vector<Defect> defects = diagnose(s.view());
  ASSERT_EQ(defects.size(), 2u);
  EXPECT_EQ(defects[0].kind, DefectKind::degenerate_facet);
  EXPECT_EQ(defects[0].vertices, (Indices{0, 3, 1}));
  EXPECT_EQ(defects[0].message,
            "triangle 0 (0, 3, 1) has zero area: vertices 1 and 3 are one, at (1, 0, 0); remove it");
  EXPECT_EQ(defects[1].kind, DefectKind::degenerate_segment);
  EXPECT_EQ(defects[1].vertices, (Indices{3, 1}));
}

TEST(Places, DefectsNameTheVerticesOfTheCaller) {
  // A point in the middle of a triangle of a soup: the corner that pierces it is the last vertex of all.
  Surface s = split::soup(box({0, 0, 0}, {3, 3, 3}));
  const auto n = static_cast<Index>(s.vertices.size());
  const Triangle f = s.facets[7];
  Point middle{};
  for (const Index v : f)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += s.vertices[v][k] / 3;
  s.vertices.push_back(middle);
  s.vertices.push_back({1.5, 1.5, 1.5});
  s.segments.push_back({n + 1, n});
  for (const std::vector<Defect>& defects : {diagnose(s.view()), mesh(s.view()).defects}) {
    ASSERT_EQ(defects.size(), 1u);
    EXPECT_EQ(defects[0].kind, DefectKind::vertex_in_facet);
    EXPECT_EQ(defects[0].vertices, Indices{n});
    EXPECT_EQ(defects[0].facets, Indices{7});
    EXPECT_NE(defects[0].message.find("vertex " + std::to_string(n) + " "), std::string::npos);
  }
}

TEST(Places, NonFiniteVerticesInUseAreDefects) {
  Surface s = split::soup(box());
  s.vertices[17][1] = kNan;
  for (const std::vector<Defect>& defects : {diagnose(s.view()), mesh(s.view()).defects}) {
    ASSERT_GE(defects.size(), 1u);
    EXPECT_EQ(defects[0].kind, DefectKind::non_finite_coordinate);
    EXPECT_EQ(defects[0].vertices, Indices{17});
  }
}

TEST(Places, OpenBordersNameTheVerticesOfTheCaller) {
  Surface s = split::soup(box());
  const Triangle gone = s.facets.front();
  s.facets.erase(s.facets.begin());  // its vertices, 0 to 2, are unused now
  const Result result = mesh(s.view());
  ASSERT_EQ(result.outcome, Outcome::invalid_input);
  ASSERT_EQ(result.defects.size(), 1u);
  EXPECT_EQ(result.defects[0].kind, DefectKind::encloses_nothing);
  EXPECT_EQ(result.defects[0].vertices.size(), 6u);
  EXPECT_EQ(result.report.input.left_out_vertices, 3u);
  for (std::size_t k = 0; k < 6; ++k) {
    const Index v = result.defects[0].vertices[k];
    EXPECT_GE(v, 3u);
    EXPECT_EQ(s.vertices.at(v), result.defects[0].where[k]);
    EXPECT_TRUE(std::ranges::any_of(gone, [&](Index u) { return s.vertices[u] == s.vertices[v]; }));
  }
  const std::string message = message_of_only(result.defects);
  EXPECT_NE(message.find("3 edges at vertex " + std::to_string(result.defects[0].vertices[0]) + " "),
            std::string::npos)
      << message;
}

TEST(Places, PointsOutsideNameTheVerticesOfTheCaller) {
  Surface s = split::soup(box());
  s.vertices.push_back({5, 5, 5});
  s.vertices.push_back({5, 5, 5});
  const std::vector<Defect> defects = mesh(s.view()).defects;
  ASSERT_EQ(defects.size(), 1u);
  EXPECT_EQ(defects[0].kind, DefectKind::outside_region);
  EXPECT_EQ(defects[0].vertices, Indices{36});
}

// --- check

using check_cases::Case;

Case split_case() {
  Case c = check_cases::with_steiner();
  c.surface.facet_markers.resize(c.surface.facets.size());
  for (std::size_t f = 0; f < c.surface.facets.size(); ++f)
    c.surface.facet_markers[f] = static_cast<int>(f) + 1;
  c.volume.facets = c.surface.facets;
  c.volume.facet_markers = c.surface.facet_markers;
  // Each vertex stays in use, so that the volume's order is right.
  std::vector<bool> used(c.surface.vertices.size(), false);
  for (Triangle& f : c.surface.facets) {
    if (used[f[2]]) {
      c.surface.vertices.push_back(Point(c.surface.vertices[f[2]]));
      f[2] = static_cast<Index>(c.surface.vertices.size() - 1);
      used.push_back(true);
    }
    for (const Index v : f) used[v] = true;
  }
  c.surface.vertices.push_back({0, 0, 0});     // unused, of a place in use
  c.surface.vertices.push_back({0, 0, kNan});  // unused
  return c;
}

TEST(PlacesInCheck, AMeshOfSplitVerticesHolds) {
  const Case c = split_case();
  EXPECT_EQ(check_cases::broken(c), check_cases::Names{});
  EXPECT_EQ(check_cases::detail(c, "input vertices kept").substr(0, 22), "26 distinct places of ");
}

TEST(PlacesInCheck, OneVertexForEachIsWrong) {
  Case c = check_cases::one_tetrahedron();
  c.surface.vertices.push_back({0, 0, 0});
  c.surface.facets[0][0] = 4;
  c.volume.vertices.push_back({0, 0, 0});
  EXPECT_TRUE(check_cases::broken(c).contains("no vertex unused"));
}

TEST(PlacesInCheck, FindingsNameTheSurfacesOwnVertices) {
  Case c = split_case();
  c.surface.vertices.insert(c.surface.vertices.begin(), c.surface.vertices[0]);  // unused, first
  for (Triangle& f : c.surface.facets)
    for (Index& v : f) ++v;
  EXPECT_EQ(check_cases::broken(c), check_cases::Names{});
  c.volume.vertices[2][0] += 1e-9;
  const std::string detail = check_cases::detail(c, "input vertices kept");
  EXPECT_TRUE(check_cases::contains(detail, "input vertex 3 (")) << detail;
  EXPECT_TRUE(check_cases::contains(detail, "mesh vertex 2")) << detail;
}

TEST(PlacesInCheck, WrongMarkersOfSplitFacetsAreFound) {
  Case c = split_case();
  std::swap(c.volume.facet_markers[3], c.volume.facet_markers[4]);
  EXPECT_EQ(check_cases::broken(c), check_cases::Names{"markers kept"});
}

TEST(PlacesInCheck, TheOrderOfPlacesCounts) {
  Case c = split_case();
  check_cases::exchange(c.volume, 3, 4);
  EXPECT_TRUE(check_cases::broken(c).contains("input vertices kept"));
}

TEST(PlacesInCheck, NonFiniteVerticesInUseAreMalformed) {
  Case c = split_case();
  c.surface.vertices[5][0] = kInfinity;
  EXPECT_TRUE(check_cases::broken(c).contains("well formed"));
}

// --- volumes

TEST(Places, VerticesOfVolumesDoNotChange) {
  // Two tetrahedra that touch in a place, with a vertex each.
  Volume volume;
  volume.vertices = {{0, 0, 0}, {1, 0, 0},  {0, 1, 0},  {0, 0, 1},
                     {0, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  volume.tetrahedra = {{0, 1, 2, 3}, {4, 5, 7, 6}};
  volume.regions = {1, 1};
  const UntangleResult result = untangle(volume);
  EXPECT_EQ(result.outcome, Outcome::invalid_input);
  ASSERT_EQ(result.defects.size(), 1u);
  EXPECT_EQ(result.defects[0].kind, DefectKind::repeated_vertex);
  EXPECT_EQ(result.defects[0].vertices, (Indices{0, 4}));
}

}  // namespace
}  // namespace holdfast::places_test
