// Results of the exact arrangement other than its facets.
#include "arrange/arrange.h"

#include <gtest/gtest.h>

#include <vector>

namespace holdfast::arrange {
namespace {

TEST(Arrange, TellsWhichFacetsFitted) {
  const std::vector<Point> vertices{{0, 0, 0},     {2, 0, 0}, {0, 2, 0},  {0.5, 0.5, -1},
                                    {0.5, 0.5, 1}, {3, 3, 0}, {-2, 0, 0}, {9, 9, 9}};
  // The second pierces the first, the third only shares a side with it, the fourth has no area.
  const std::vector<Triangle> facets{{0, 1, 2}, {3, 4, 5}, {0, 2, 6}, {0, 7, 7}};
  const Complex complex{vertices, facets, {}, {}, {}};
  const Elements elements = elements_of(complex);
  const Arrangement arrangement = arrange(complex, elements, [](double) {});
  EXPECT_FALSE(arrangement.is_same);
  EXPECT_EQ(arrangement.fitted, (std::vector<std::uint8_t>{0, 0, 1, 0}));
}

}  // namespace
}  // namespace holdfast::arrange
