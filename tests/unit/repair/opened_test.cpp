// Parts that were closed and are open now.
#include "repair/opened.h"

#include <gtest/gtest.h>

#include <vector>

#include "small_surfaces.h"
#include "surface/complex.h"

namespace holdfast::repairing::opened_test {
namespace {

constexpr Index kFacetsOfBox = 12;

/// Two separate boxes, each a part, with so many facets left.
Index opened_of(Index left_of_first, Index left_of_second) {
  Surface given, left;
  small::add_box(given, {0, 0, 0}, {1, 1, 1});
  small::add_box(given, {2, 0, 0}, {3, 1, 1});
  std::vector<Index> part(kFacetsOfBox, 0);
  part.insert(part.end(), kFacetsOfBox, 1);
  const State before = state_of(given.view());
  State after = before;
  after.facets.clear();
  after.facet_parents = {};
  for (Index f = 0; f < given.facets.size(); ++f) {
    const bool stays = f < kFacetsOfBox ? f < left_of_first : f - kFacetsOfBox < left_of_second;
    if (!stays) continue;
    after.facets.push_back(before.facets[f]);
    after.facet_parents.add(before.facet_parents.of(f));
  }
  return opened_part(before, after, part);
}

TEST(Opened, IsAPartThatLostAFacet) {
  EXPECT_EQ(opened_of(kFacetsOfBox, kFacetsOfBox), no_index);
  EXPECT_EQ(opened_of(kFacetsOfBox - 1, kFacetsOfBox), 0u);
  EXPECT_EQ(opened_of(kFacetsOfBox, kFacetsOfBox - 1), 1u);
}

TEST(Opened, IsAPartThatLostEverything) {
  EXPECT_EQ(opened_of(0, kFacetsOfBox), 0u);
  EXPECT_EQ(opened_of(kFacetsOfBox, 0), 1u);
}

// Two equal open parts become one sheet, which is as open as they were.
TEST(Opened, IsNoPartThatWasOpenAlreadyAndCoincidesWithAnother) {
  Surface given;
  small::add_triangle(given, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  small::add_triangle(given, {0, 0, 0}, {0, 1, 0}, {1, 0, 0});
  const State before = state_of(given.view());
  State after = before;
  after.facets.resize(1);
  after.facet_parents = {};
  after.facet_parents.add(std::vector<Index>{0, 1});
  EXPECT_EQ(opened_part(before, after, std::vector<Index>{0, 1}), no_index);
}

}  // namespace
}  // namespace holdfast::repairing::opened_test
