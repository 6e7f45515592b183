// As many elements as sizes of regions ask for, even if the surface bears few of them.
#include "api/enough_elements.h"

#include <gtest/gtest.h>

#include <functional>

#include "hard_surfaces.h"
#include "holdfast/check.h"
#include "holdfast/holdfast.h"
#include "small_surfaces.h"

namespace holdfast::enough_elements_test {
namespace {

// The number of elements at which a search ends, given those of each factor, and the number of tries.
struct Found {
  double factor;
  int tries;
};
Found search(double asked, const std::function<double(double)>& made) {
  SizesForEnough sizes({asked});
  int tries = 1;
  for (; sizes.goes_on(std::vector<double>{made(sizes.factors()[0])}); ++tries) {
  }
  return {sizes.factors()[0], tries};
}

TEST(SizesForEnough, LeavesTheUsersSizesWhereTheyGiveEnoughOrMany) {
  for (const double part : {0.7, 1.0, 30.0}) {
    const Found found = search(1000, [&](double f) { return 1000 * part / (f * f * f); });
    EXPECT_EQ(found.factor, 1);
    EXPECT_EQ(found.tries, 1);
  }
  EXPECT_EQ(search(0, [](double) { return 10; }).factor, 1) << "no size asked for";
}

TEST(SizesForEnough, MakesUpForTwoThirdsThatAreMissing) {
  const auto made = [](double f) { return 300 / (f * f * f); };
  const Found found = search(1000, made);
  EXPECT_GE(made(found.factor), 600);
  EXPECT_LE(made(found.factor), 750);
  EXPECT_EQ(found.tries, 2);
}

// Walls that get points below some size.
TEST(SizesForEnough, LooksBetweenTooFewAndTooMany) {
  const auto made = [](double f) { return f > 0.85 ? 100 : f > 0.65 ? 800 : 3000; };
  const Found found = search(1000, made);
  EXPECT_EQ(made(found.factor), 800);
  EXPECT_LE(found.tries, 4);
}

TEST(SizesForEnough, EndsWhereNothingHelps) {
  EXPECT_LE(search(1000, [](double) { return 100; }).tries, 5);
  EXPECT_LE(search(1000, [](double f) { return f > 0.999 ? 100 : 3000; }).tries, 6);
}

// Walls get points between 0.7 and 0.5: half of the size at once would give more than three times as many.
TEST(SizesForEnough, TakesSmallStepsWhereAFillingIsCostly) {
  const auto second = [](double asked) {
    SizesForEnough sizes({asked});
    EXPECT_TRUE(sizes.goes_on(std::vector<double>{asked / 20}));
    return sizes.factors()[0];
  };
  EXPECT_EQ(second(1000), 0.5);
  EXPECT_EQ(second(1e6), 0.65);
  const auto made = [](double f) { return f > 0.7 ? 50'000 : 480'000 / (f * f * f) * 0.4; };
  const Found found = search(1e6, made);
  EXPECT_GE(made(found.factor), 580'000);
  EXPECT_LE(found.tries, 4);
}

TEST(SizesForEnough, TakesTooManyRatherThanTooFew) {
  const auto made = [](double f) { return f > 0.55 ? 6 : 3000; };
  const Found found = search(1000, made);
  EXPECT_EQ(made(found.factor), 3000);
  EXPECT_LE(found.tries, 6);
}

// Walls that get points only if facets need less as well.
TEST(SizesForEnough, LowersWhatFacetsNeedWhereTheLeastFactorIsNotEnough) {
  SizesForEnough sizes({1000});
  int tries = 1;
  const auto made = [&] { return sizes.part_of_most_need() < 0.8 ? 800.0 : 300.0; };
  EXPECT_EQ(sizes.part_of_most_need(), 1);
  for (; sizes.goes_on(std::vector<double>{made()}); ++tries) {
    if (sizes.part_of_most_need() < 1) {
      EXPECT_EQ(sizes.factors()[0], 0.5);
    }
  }
  EXPECT_EQ(made(), 800);
  EXPECT_GE(sizes.part_of_most_need(), 0.5);
  EXPECT_LE(tries, 5);
}

TEST(SizesForEnough, TakesEachRegionAlone) {
  SizesForEnough sizes({1000, 1000});
  EXPECT_TRUE(sizes.goes_on(std::vector<double>{900, 200}));
  EXPECT_EQ(sizes.factors()[0], 1);
  EXPECT_LT(sizes.factors()[1], 0.8);
}

double regular(double volume, double size) { return 8.485281374 * volume / (size * size * size); }

Options with_size(double size) {
  Options options;
  options.sizes = Sizes{};
  options.sizes->size = size;
  return options;
}

// Two triangles per side, twenty times as long as the plate is thick.
TEST(EnoughElements, AThinPlateOfLargeTriangles) {
  const Surface plate = small::box({0, 0, 0}, {20, 20, 1});
  const double size = 0.5;
  const Result result = mesh(plate.view(), with_size(size));
  ASSERT_EQ(result.outcome, Outcome::done);
  const auto elements = static_cast<double>(result.report.tetrahedra);
  EXPECT_GT(elements, 0.5 * regular(400, size));
  EXPECT_LT(elements, 1.1 * regular(400, size));
  ASSERT_EQ(result.report.field.smaller_sizes.size(), 1u);
  const Report::Field::SmallerSize& smaller = result.report.field.smaller_sizes[0];
  EXPECT_EQ(smaller.region, 1);
  EXPECT_EQ(smaller.asked, size);
  EXPECT_LT(smaller.used, size);
  EXPECT_GE(smaller.used, 0.5 * size);
  EXPECT_TRUE(check(plate.view(), result.volume).holds());
}

TEST(EnoughElements, ASphereOfGoodTrianglesKeepsTheSizeThatIsAskedFor) {
  const Surface sphere = hard::icosphere(3);
  const Result result = mesh(sphere.view(), with_size(0.1));
  EXPECT_TRUE(result.report.field.smaller_sizes.empty());
  EXPECT_GT(static_cast<double>(result.report.tetrahedra), 0.65 * regular(4.1, 0.1));
}

// The triangles are thirty times as large as the size. Small elements next to them are bad.
TEST(EnoughElements, ACubeOfTwelveTrianglesHasFewBadElements) {
  const Surface cube = small::box({0, 0, 0}, {1, 1, 1});
  const double size = 1.0 / 20;
  const Result result = mesh(cube.view(), with_size(size));
  ASSERT_EQ(result.outcome, Outcome::done);
  const auto elements = static_cast<double>(result.report.tetrahedra);
  EXPECT_GT(elements, 0.5 * regular(1, size));
  EXPECT_LT(elements, regular(1, size));
  EXPECT_LT(static_cast<double>(result.report.field.below_10_deg), 0.001 * elements);
}

// Bounds, functions and sizes at vertices are used unchanged.
TEST(EnoughElements, SizesThatAFunctionGivesAreItsOwn) {
  const Surface plate = small::box({0, 0, 0}, {20, 20, 1});
  Options options = with_size(0.5);
  options.sizes->field = [](const Point&) { return 0.5; };
  EXPECT_TRUE(mesh(plate.view(), options).report.field.smaller_sizes.empty());
}

TEST(EnoughElements, TheSameMeshOnAnyNumberOfThreads) {
  const Surface plate = small::box({0, 0, 0}, {20, 20, 1});
  Options options = with_size(0.3);
  options.threads = 1;
  const Result one = mesh(plate.view(), options);
  options.threads = 3;
  const Result three = mesh(plate.view(), options);
  EXPECT_FALSE(one.report.field.smaller_sizes.empty());
  EXPECT_EQ(one.volume.vertices, three.volume.vertices);
  EXPECT_EQ(one.volume.tetrahedra, three.volume.tetrahedra);
}

}  // namespace
}  // namespace holdfast::enough_elements_test
