// The queue of the sides of a surface that is being bent.
#include "repair/bent.h"

#include <gtest/gtest.h>

namespace holdfast::repairing::bent_test {
namespace {

/// A strip of two triangles, with sides of different lengths.
const std::vector<Point> kVertices{{0, 0, 0}, {10, 0, 0}, {0, 3, 0}, {9, 4, 0}, {2, 2, 0}};

std::vector<Side> examined(BentSurface& surface) {
  std::vector<Side> sides;
  while (const std::optional<Side> side = surface.next_side()) sides.push_back(*side);
  return sides;
}

TEST(BentSurface, ExaminesTheLongestSidesFirst) {
  BentSurface surface(kVertices);
  surface.add(BentFacet{{0, 1, 2}, {0}, {0}});
  surface.add(BentFacet{{2, 1, 3}, {1}, {1}});
  EXPECT_EQ(examined(surface), (std::vector<Side>{{1, 2}, {0, 1}, {2, 3}, {1, 3}, {0, 2}}));
}

TEST(BentSurface, LeavesOutTheSidesOfIdleFacets) {
  BentSurface surface(kVertices);
  surface.add(BentFacet{{0, 1, 2}, {0}, {0}}, true);
  surface.add(BentFacet{{2, 1, 3}, {1}, {1}});
  EXPECT_EQ(examined(surface), (std::vector<Side>{{1, 2}, {2, 3}, {1, 3}}));
  EXPECT_NE(surface.at({0, 1}), nullptr);
}

/// An idle side is examined for a later facet only if its turn is still to come.
TEST(BentSurface, ExaminesAnIdleSideForALaterFacetInItsTurn) {
  BentSurface surface(kVertices);
  surface.add(BentFacet{{0, 1, 2}, {0}, {0}}, true);
  surface.add(BentFacet{{2, 1, 3}, {1}, {1}});
  EXPECT_EQ(surface.next_side(), (Side{1, 2}));
  EXPECT_EQ(surface.next_side(), (Side{2, 3}));
  surface.add(BentFacet{{0, 4, 2}, {2}, {2}});  // at the side (0, 2)
  surface.add(BentFacet{{0, 4, 1}, {3}, {3}});  // at the side (0, 1), whose turn is past
  EXPECT_EQ(examined(surface), (std::vector<Side>{{1, 4}, {1, 3}, {0, 2}, {0, 4}, {2, 4}}));
}

TEST(BentSurface, ExaminesTheSidesOfAnIdleFacetThatGetsMoreVertices) {
  BentSurface surface(kVertices);
  surface.add(BentFacet{{0, 1, 2}, {0}, {0}}, true);
  surface.add(BentFacet{{1, 2, 0}, {1}, {1}});
  EXPECT_EQ(surface.facet(0).lists, (std::vector<Index>{0, 1}));
  EXPECT_EQ(examined(surface), (std::vector<Side>{{1, 2}, {0, 1}, {0, 2}}));
}

}  // namespace
}  // namespace holdfast::repairing::bent_test
