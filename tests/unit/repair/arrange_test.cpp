// Results of the exact arrangement other than its facets.
#include "arrange/arrange.h"

#include <gtest/gtest.h>

#include <vector>

namespace holdfast::arrange::arrange_test {
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

// Ten times the same triangle: 45 pairs, and no point.
TEST(Arrange, EndsWithTooManyPairs) {
  const std::vector<Point> vertices{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  const std::vector<Triangle> facets(10, {0, 1, 2});
  const Complex complex{vertices, facets, {}, {}, {}};
  const Elements elements = elements_of(complex);
  ArrangeOptions options;
  options.most_pairs = 45;
  EXPECT_EQ(arrange(
                complex, elements, [](double) {}, options)
                .pairs,
            45u);
  options.most_pairs = 44;
  EXPECT_THROW((void)arrange(
                   complex, elements, [](double) {}, options),
               TooManyPoints);
}

/// The next search need not compare what fitted, even if the arrangement is given up.
TEST(Arrange, TellsWhatFittedIfThereAreTooManyPoints) {
  const std::vector<Point> vertices{{0, 0, 0},   {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1},
                                    {9, 9, 0.5}, {0, 0, 8}, {4, 0, 8}, {0, 4, 8}};
  const std::vector<Triangle> facets{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  const Complex complex{vertices, facets, {}, {}, {}};
  ArrangeOptions options;
  options.most_points = 1;
  try {
    (void)arrange(
        complex, elements_of(complex), [](double) {}, options);
    FAIL() << "two points are too many";
  } catch (const TooManyPoints& many) {
    EXPECT_EQ(many.count(), 2u);
    EXPECT_EQ(many.fitted, (std::vector<std::uint8_t>{0, 0, 1}));
  }
}

}  // namespace
}  // namespace holdfast::arrange::arrange_test
