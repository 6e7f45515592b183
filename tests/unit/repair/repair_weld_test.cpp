// Repairs that weld within a distance given by the caller.
#include <gtest/gtest.h>

#include <array>

#include "holdfast/repair.h"
#include "repair/rounding.h"
#include "small_surfaces.h"

namespace holdfast::repair_weld_test {
namespace {

void expect_valid(const RepairResult& repaired) {
  ASSERT_EQ(repaired.outcome, Outcome::done) << repaired.message;
  EXPECT_TRUE(diagnose(repaired.surface.view()).empty());
}

// Welding puts a vertex on a side of the first facet, so that rounding gets parts of it.
TEST(RepairWithWeld, PartsOfWeldedFacetsNameTheFacetsOfTheInput) {
  Surface surface;
  surface.vertices = {{0, 0, 0},  {4, 0, 0},  {0, 4, 0},   {2, -1e-9, 0}, {4, -3, 0},
                      {0, -3, 0}, {1, 1, -1}, {1, 1, 1.5}, {1.5, 0.5, 1}};
  surface.facets = {{0, 1, 2}, {3, 5, 4}, {6, 7, 8}};
  RepairOptions options;
  options.weld = 1e-6;
  options.exact = true;
  const RepairResult result = repair(surface.view(), options);
  ASSERT_EQ(result.outcome, Outcome::done);
  for (const IndexLists* lists : {&result.parents, &result.exact.parents}) {
    std::array<std::size_t, 3> parts{};
    for (std::size_t f = 0; f < lists->size(); ++f) {
      ASSERT_EQ((*lists)[f].size(), 1u);
      ++parts.at((*lists)[f][0]);
    }
    EXPECT_GE(parts[0], 4u);
    EXPECT_EQ(parts[1], 1u);
    EXPECT_GE(parts[2], 2u);
  }
}

// Faces that overlap in a plane: triangles led through the vertices in them had many diagonals, which
// crossed.
TEST(RepairWithWeld, LeavesVerticesThatLieExactlyOnFacesToTheCut) {
  Surface surface;
  small::add_box(surface, {0, 0, 0}, {3, 3, 1});
  small::add_box(surface, {1, 1, 1}, {4, 2, 2});
  small::add_box(surface, {0.5, 1, 0}, {2, 2.5, 1});
  RepairOptions options;
  const RepairResult plain = repair(surface, options);
  options.weld = 1e-3;
  const RepairResult welded = repair(surface, options);
  expect_valid(welded);
  EXPECT_EQ(welded.surface.vertices, plain.surface.vertices);
  EXPECT_EQ(welded.surface.facets, plain.surface.facets);
  EXPECT_EQ(welded.max_displacement, plain.max_displacement);

  surface.vertices[8][2] += 1e-4;  // no longer on the face below
  const RepairResult bent = repair(surface, options);
  expect_valid(bent);
  EXPECT_GT(bent.max_displacement, 0.9e-4);
  EXPECT_LE(bent.max_displacement, options.weld);
}

// Rounding leaves out vertices that nothing uses, but for those of the input, and then numbers the others
// anew. With the numbers of before, it read far beyond the vertices that are left.
TEST(RepairWithWeld, VerticesThatWeldingAddsAreComparedByTheirPlace) {
  constexpr Index kUnused = 64;
  Surface surface;
  surface.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  for (Index k = 0; k < kUnused; ++k) surface.vertices.push_back({9, 9, 9.0 + k});
  surface.vertices.insert(surface.vertices.end(), {{1, 1, -1}, {1, 1, 1.5}, {1.5, 0.5, 1}});
  surface.facets = {{0, 1, 2}, {kUnused + 3, kUnused + 4, kUnused + 5}};
  repairing::State state = repairing::state_of(surface.view());
  state.input_vertices = 3;
  RepairOptions options;
  options.join = 1e-12;  // compares the surface with the given one
  RepairReport report;
  ExactSurface exact;
  const repairing::Rounded rounded = repairing::round_arranged(
      std::move(state), options, report, exact, [](double) {}, Threads(1));
  ASSERT_TRUE(rounded.is_valid);
  EXPECT_EQ(rounded.state.facets.size(), 8U);
  EXPECT_EQ(rounded.state.vertices.size(), 8U);
  EXPECT_EQ(rounded.state.input_vertices, 3U);
}

// Two patches that divide their common curve differently: their sides pass each other between the vertices.
TEST(RepairWithWeld, FreeSidesThatPassWithinTheWeldShareAVertex) {
  Surface surface;
  surface.vertices = {{0, 0, 0}, {4, 0, 0}, {2, 0, 3}, {1, -1, -1e-9}, {3, 1, -1e-9}, {2, 0, -3}};
  surface.facets = {{0, 1, 2}, {3, 4, 5}};
  RepairOptions options;
  options.weld = 1e-6;
  const RepairResult free = repair(surface.view(), options);
  expect_valid(free);
  EXPECT_EQ(free.surface.facets.size(), 4u);
  EXPECT_EQ(free.surface.vertices.size(), 7u);
  EXPECT_LE(free.max_displacement, options.weld);
}

/// A roof whose ridge lies along the x axis; `over` turns it upside down, with its ridge along the y axis.
void add_roof(Surface& surface, bool over, double height) {
  const auto first = static_cast<Index>(surface.vertices.size());
  for (const Point& p : {Point{-1, 0, 0}, {1, 0, 0}, {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}})
    surface.vertices.push_back(over ? Point{p[1], p[0], height - p[2]} : p);
  for (const Triangle& t :
       {Triangle{0, 2, 3}, {0, 3, 1}, {0, 1, 4}, {0, 4, 5}, {2, 5, 4}, {2, 4, 3}, {0, 5, 2}, {1, 3, 4}})
    surface.facets.push_back({t[0] + first, t[1] + first, t[2] + first});
}

TEST(RepairWithWeld, EdgesOfBodiesThatTouchShareAVertex) {
  for (const double height : {1e-9, -1e-9}) {
    Surface surface;
    add_roof(surface, false, 0);
    add_roof(surface, true, height);
    RepairOptions options;
    options.weld = 1e-6;
    const RepairResult touching = repair(surface.view(), options);
    expect_valid(touching);
    EXPECT_EQ(touching.surface.vertices.size(), 13u);
    EXPECT_EQ(touching.surface.facets.size(), 20u);
    EXPECT_LE(touching.max_displacement, options.weld);
    options.weld = 1e-10;
    EXPECT_NE(repair(surface.view(), options).surface.vertices.size(), 13u);
  }
}

/// Triangles that connect two such roofs, far from their ridges.
void add_handle(Surface& surface) {
  const auto handle = static_cast<Index>(surface.vertices.size());
  surface.vertices.push_back({-3, 0, 0});
  for (const Triangle& t : {Triangle{2, 5, handle}, {8, 9, handle}, {2, handle, 8}})
    surface.facets.push_back(t);
}

// What is thin within a body stays, so that no wall becomes a single triangle.
TEST(RepairWithWeld, EdgesOfOneBodyShareAVertexWithinSomeLastBits) {
  struct {
    double height, weld;
  } constexpr cases[] = {{0x1p-51, 0x1p-46}, {0x1p-51, 1e-6}, {1e-9, 1e-6}};
  for (const auto& [height, weld] : cases) {
    Surface surface;
    add_roof(surface, false, 0);
    add_roof(surface, true, height);
    add_handle(surface);
    ASSERT_TRUE(diagnose(surface.view()).empty());
    RepairOptions options;
    options.weld = weld;
    const RepairResult welded = repair(surface.view(), options);
    expect_valid(welded);
    EXPECT_EQ(welded.surface.vertices.size(), height < 1e-12 ? 14u : 13u);
    EXPECT_LE(welded.max_displacement, weld);
  }
}

// Where bodies touch with faces, all sides cross each other within the tolerance. Vertices there would not
// give the faces the same triangles.
TEST(RepairWithWeld, SidesOfFacesThatCoincideStayAsTheyAre) {
  Surface surface;
  small::add_box(surface, {-2, -1, -1}, {2, 1, 0});
  small::add_box(surface, {-1, -2, 1e-9}, {1, 2, 1});
  RepairOptions options;
  options.weld = 1e-6;
  const RepairResult welded = repair(surface.view(), options);
  expect_valid(welded);
  EXPECT_EQ(welded.surface.facets, surface.facets);
}

/// n blades along x stand upon n along y, a little above them.
Surface combs(Index n) {
  Surface surface;
  const auto add = [&](const Point& a, const Point& b, const Point& c) {
    const auto first = static_cast<Index>(surface.vertices.size());
    surface.vertices.insert(surface.vertices.end(), {a, b, c});
    surface.facets.push_back({first, first + 1, first + 2});
  };
  const double end = n;
  for (Index k = 0; k < n; ++k) {
    const double at = k + 0.25;
    add({-1, at, 1e-9}, {end, at, 1e-9}, {-1, at, 1});
    add({at, -1, 0}, {at, end, 0}, {at, -1, -1});
  }
  return surface;
}

// Where sides of bodies pass each other nearly everywhere, their sheets lie upon each other, and vertices
// there would make more of it.
TEST(RepairWithWeld, FewPassingSidesShareVertices) {
  RepairOptions options;
  options.weld = 1e-6;
  const Surface few = combs(10), many = combs(48);
  const RepairResult joined = repair(few.view(), options), apart = repair(many.view(), options);
  expect_valid(joined);
  expect_valid(apart);
  EXPECT_EQ(joined.surface.vertices.size(), few.vertices.size() + 100);
  EXPECT_EQ(apart.surface.vertices.size(), many.vertices.size());
}

}  // namespace
}  // namespace holdfast::repair_weld_test
