// Decisions made for the user, and doubts about the input: reported in the result.
#include <gtest/gtest.h>

#include <algorithm>

#include "holdfast/holdfast.h"
#include "small_surfaces.h"

namespace holdfast::decisions_test {
namespace {

std::vector<WarningKind> kinds(const Result& result) {
  std::vector<WarningKind> all;
  for (const Warning& warning : result.warnings) all.push_back(warning.kind);
  return all;
}

using Kinds = std::vector<WarningKind>;

TEST(Decisions, TheRuleThatKeptRegions) {
  const Surface box = small::box();
  EXPECT_EQ(mesh(box.view()).report.keep, Keep::winding);
  for (const Keep keep : {Keep::bounded, Keep::winding, Keep::box}) {
    Options options;
    options.keep = keep;
    EXPECT_EQ(mesh(box.view(), options).report.keep, keep);
  }
  Options options;
  options.stop_after = Stage::flips;
  EXPECT_EQ(mesh(box.view(), options).report.keep, Keep::automatic);
}

TEST(Decisions, TheTriangleThatIsTurned) {
  for (const Index turned : {0u, 7u}) {
    Surface surface = small::nested(false);
    std::swap(surface.facets[turned][0], surface.facets[turned][1]);
    const Result result = mesh(surface.view());
    EXPECT_EQ(result.report.keep, Keep::bounded);
    EXPECT_EQ(result.report.regions, 2u);  // not 1, as for a consistent orientation
    EXPECT_EQ(result.report.turned_facets, std::vector<Index>{turned});
    ASSERT_EQ(kinds(result), Kinds{WarningKind::orientation});
    EXPECT_EQ(result.warnings[0].facets, std::vector<Index>{turned});
    EXPECT_NE(result.warnings[0].message.find("triangle " + std::to_string(turned) + " is turned"),
              std::string::npos)
        << result.warnings[0].message;
  }
}

// The wall between two materials faces one of them: no triangle is wrong.
TEST(Decisions, AnInterfaceTurnsNothing) {
  const Result result = mesh(small::touching());
  EXPECT_EQ(result.report.keep, Keep::bounded);
  EXPECT_EQ(result.report.turned_facets.size(), 2u);
  EXPECT_EQ(kinds(result), Kinds{});
}

// Two boxes with a wall of ten triangles, the last two in the middle of it, round a square.
Surface with_fine_wall() {
  Surface surface = small::touching();
  surface.facets.resize(surface.facets.size() - 2);
  const std::array<Index, 4> outer{1, 3, 7, 5};
  const auto first = static_cast<Index>(surface.vertices.size());
  for (const auto& [y, z] : {std::pair{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.75}, {0.25, 0.75}})
    surface.vertices.push_back({1, y, z});
  for (Index k = 0; k < 4; ++k) {
    const Index next = (k + 1) % 4;
    surface.facets.push_back({outer[k], outer[next], first + next});
    surface.facets.push_back({outer[k], first + next, first + k});
  }
  surface.facets.push_back({first, first + 1, first + 2});
  surface.facets.push_back({first, first + 2, first + 3});
  return surface;
}

TEST(OpenInterface, IsTold) {
  Surface surface = with_fine_wall();
  ASSERT_EQ(mesh(surface.view()).report.regions, 2u);
  EXPECT_EQ(kinds(mesh(surface.view())), Kinds{});
  surface.facets.pop_back();
  for (const auto& sizes : {std::optional<Sizes>(), std::optional(Sizes{})}) {
    Options options;
    options.sizes = sizes;
    const Result result = mesh(surface.view(), options);
    EXPECT_EQ(result.report.regions, 1u);
    ASSERT_EQ(kinds(result), Kinds{WarningKind::open_interface});
    const Warning& warning = result.warnings[0];
    EXPECT_EQ(warning.facets.size(), 9u);
    EXPECT_EQ(warning.border, (std::vector<Segment>{{12, 14}, {12, 15}, {14, 15}}));
    EXPECT_NE(warning.message.find("open border of 3 edges at vertex 12 (1, 0.25, 0.25)"), std::string::npos)
        << warning.message;
  }
}

// With random orientations, because a wall may have any.
TEST(OpenInterface, IsToldHoweverItsTrianglesAreTurned) {
  Surface surface = with_fine_wall();
  surface.facets.pop_back();
  for (std::size_t f = 20; f < surface.facets.size(); f += 2)
    std::swap(surface.facets[f][0], surface.facets[f][1]);
  const std::vector<WarningKind> all = kinds(mesh(surface.view()));
  EXPECT_EQ(std::count(all.begin(), all.end(), WarningKind::open_interface), 1);
}

TEST(OpenInterface, OfTwoTrianglesIsToldByMarkers) {
  Surface surface = small::touching();
  surface.facets.pop_back();
  EXPECT_EQ(kinds(mesh(surface.view())), Kinds{});
  for (std::size_t f = 0; f < surface.facets.size(); ++f) surface.facet_markers.push_back(f < 10 ? 1 : 2);
  EXPECT_EQ(kinds(mesh(surface.view())), Kinds{WarningKind::open_interface});
}

TEST(OpenInterface, SheetsThatJutIntoARegionAreNone) {
  Surface surface = with_fine_wall();
  surface.facets.resize(22);  // the first two triangles of the wall, at one of its sides
  EXPECT_EQ(kinds(mesh(surface.view())), Kinds{});
  Surface floating = small::box({0, 0, 0}, {4, 4, 4});
  small::add_triangle(floating, {1, 1, 1}, {2, 1, 1}, {1, 2, 1});
  EXPECT_EQ(kinds(mesh(floating.view())), Kinds{});
}

TEST(OpenInterface, IsNamedWhereTwoSeedsMeet) {
  Surface surface = with_fine_wall();
  surface.facets.pop_back();
  Options options;
  options.regions = {{{0.5, 0.4, 0.6}, 3}, {{1.5, 0.4, 0.6}, 4}};
  try {
    static_cast<void>(mesh(surface.view(), options));
    FAIL() << "two seeds in one region";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("open border"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace holdfast::decisions_test
