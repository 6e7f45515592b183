// Repairs that weld within a distance given by the caller.
#include <gtest/gtest.h>

#include <array>

#include "holdfast/repair.h"

namespace holdfast {
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

  surface.vertices.push_back({2, 3, 3});
  surface.facets.push_back({1, 0, 6});
  const RepairResult shared = repair(surface.view(), options);
  expect_valid(shared);
  EXPECT_EQ(shared.surface.facets.size(), 3u);
}

}  // namespace
}  // namespace holdfast
