// Regions of a surface found without a mesh, compared with those of the mesh.
#include "surface/space.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "holdfast/holdfast.h"
#include "holdfast/repair.h"
#include "small_surfaces.h"

namespace holdfast::space_test {
namespace {

DividedSpace divided(const Surface& surface) {
  return divide_space(surface.view(), [](double) {});
}

/// The mesh in a box round the surface has the same regions: the faces of facets see them by other names.
void expect_regions_of_mesh(const Surface& surface) {
  Options options;
  options.keep = Keep::box;
  options.stop_after = Stage::classify;
  const Result result = mesh(surface.view(), options);
  ASSERT_EQ(result.outcome, Outcome::done) << result.message;
  const DividedSpace space = divided(surface);
  ASSERT_EQ(space.of_facet.size(), surface.facets.size());
  std::map<Index, int> by_space;
  std::map<int, Index> by_mesh;
  for (std::size_t f = 0; f < surface.facets.size(); ++f)
    for (std::size_t side : {0, 1}) {
      const std::optional<int> region = result.facet_regions[f][side];
      ASSERT_TRUE(region.has_value());
      EXPECT_EQ(by_space.try_emplace(space.of_facet[f][side], *region).first->second, *region);
      EXPECT_EQ(by_mesh.try_emplace(*region, space.of_facet[f][side]).first->second, space.of_facet[f][side]);
    }
}

TEST(DividedSpace, ABoxHasItsInsideBehindItsFacets) {
  const DividedSpace space = divided(small::box());
  EXPECT_EQ(space.regions, 2u);
  for (const auto& sides : space.of_facet) EXPECT_EQ(sides, (std::array<Index, 2>{0, 1}));
}

TEST(DividedSpace, AnOpenSurfaceDividesNothing) {
  const DividedSpace space = divided(small::open_box());
  EXPECT_EQ(space.regions, 1u);
  for (const auto& sides : space.of_facet) EXPECT_EQ(sides, (std::array<Index, 2>{0, 0}));
}

TEST(DividedSpace, NestedBoxesAreOneInTheOther) {
  const DividedSpace space = divided(small::nested(true));
  EXPECT_EQ(space.regions, 3u);
  EXPECT_EQ(space.of_facet[0], (std::array<Index, 2>{0, 1}));
  EXPECT_EQ(space.of_facet[12], (std::array<Index, 2>{1, 2}));
}

TEST(DividedSpace, BoxesWithAWallInCommon) {
  EXPECT_EQ(divided(small::touching()).regions, 3u);
  expect_regions_of_mesh(small::touching());
}

// One box touches the inside of another with a corner, which is a vertex of both: no side connects them.
TEST(DividedSpace, ABoxThatTouchesTheInsideOfAnotherWithACorner) {
  Surface surface = small::box({0, 0, 0}, {4, 4, 4});
  small::add_box(surface, {0, 0, 0}, {1, 1, 1});
  for (Index v = 8; v < 16; ++v) {  // leant, so that only its corner stays on the large box
    const Point p = surface.vertices[v];
    for (std::size_t k = 0; k < 3; ++k)
      surface.vertices[v][k] = p[k] + 0.25 * p[(k + 1) % 3] + 0.25 * p[(k + 2) % 3];
  }
  for (std::size_t f = 12; f < 24; ++f)
    for (Index& v : surface.facets[f])
      if (v == 8) v = 0;
  ASSERT_TRUE(diagnose(surface.view()).empty());
  EXPECT_EQ(divided(surface).regions, 3u);
  expect_regions_of_mesh(surface);
}

// A line along an axis meets many sides and vertices of a grid, so other lines are tried.
TEST(DividedSpace, AGridOfBoxesAlongTheAxes) {
  Surface surface;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 3; ++z)
        small::add_box(surface, {2.0 * x, 2.0 * y, 2.0 * z}, {2.0 * x + 1, 2.0 * y + 1, 2.0 * z + 1});
  EXPECT_EQ(divided(surface).regions, 28u);
  expect_regions_of_mesh(surface);
}

// Boxes and single triangles that cross each other in all ways, after their repair.
TEST(DividedSpace, RandomSurfacesHaveTheRegionsOfTheirMesh) {
  std::mt19937_64 random(7);
  std::size_t most = 0;
  for (int round = 0; round < 40; ++round) {
    std::uniform_real_distribution<double> anywhere(-2, 2), size(0.2, 3);
    Surface surface;
    for (std::size_t k = 0; k < 2 + random() % 8; ++k) {
      Point low{anywhere(random), anywhere(random), anywhere(random)};
      if (round % 2 == 0)  // faces that coincide, and sides with up to four boxes
        for (double& x : low) x = std::round(x);
      const double edge = round % 2 == 0 ? 1 + static_cast<double>(random() % 2) : size(random);
      small::add_box(surface, low, {low[0] + edge, low[1] + edge, low[2] + edge}, random() % 2 == 0);
    }
    for (std::size_t k = 0; k < random() % 4; ++k)
      small::add_triangle(surface, {anywhere(random), anywhere(random), anywhere(random)},
                          {anywhere(random), anywhere(random), anywhere(random)},
                          {anywhere(random), anywhere(random), anywhere(random)});
    const RepairResult repaired = repair(surface.view());
    ASSERT_EQ(repaired.outcome, Outcome::done) << repaired.message;
    expect_regions_of_mesh(repaired.surface);
    most = std::max<std::size_t>(most, divided(repaired.surface).regions);
  }
  EXPECT_GT(most, 20u);
}

}  // namespace
}  // namespace holdfast::space_test
