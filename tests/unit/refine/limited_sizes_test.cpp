// Sizes limited by the surface: the report and the warning.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hard_surfaces.h"
#include "holdfast/holdfast.h"
#include "small_surfaces.h"

namespace holdfast::limited_sizes_test {
namespace {

Options with_size(double size) {
  Options options;
  options.sizes = Sizes{};
  options.sizes->size = size;
  return options;
}

bool warns_of_sizes(const Result& result) {
  return std::any_of(result.warnings.begin(), result.warnings.end(),
                     [](const Warning& w) { return w.kind == WarningKind::sizes; });
}

Surface plate() { return small::box({0, 0, 0}, {1, 1, 0.125}); }

TEST(LimitedSizes, APlateOfTwelveTrianglesBearsNoSmallElements) {
  const Surface surface = plate();
  const Result result = mesh(surface.view(), with_size(0.0625));
  const Report::Field& field = result.report.field;
  EXPECT_GT(field.limited_asked_volume, 0.7);
  EXPECT_LE(field.limited_asked_volume, field.limited_volume);
  EXPECT_LE(field.limited_volume, 1 + 1e-12);
  ASSERT_FALSE(field.limiting.empty());
  double sum = 0;
  for (const Report::Field::Limiting& f : field.limiting) {
    EXPECT_LT(f.facet, surface.facets.size());
    EXPECT_EQ(f.wanted, 0.0625);
    EXPECT_GT(f.bearable, f.wanted);
    sum += f.volume;
  }
  EXPECT_NEAR(sum, field.limited_volume, 1e-12);
  EXPECT_TRUE(std::is_sorted(field.limiting.begin(), field.limiting.end(),
                             [](const auto& f, const auto& g) { return f.volume > g.volume; }));
  ASSERT_TRUE(warns_of_sizes(result));
  const std::string& message = result.warnings.back().message;
  EXPECT_NE(message.find("in place of 0.0625"), std::string::npos) << message;
}

TEST(LimitedSizes, NothingIsLimitedOnGoodTrianglesOfTheSize) {
  const Surface sphere = hard::icosphere(2);
  for (const Options& options : {with_size(0), with_size(0.4)}) {
    const Result result = mesh(sphere.view(), options);
    EXPECT_EQ(result.report.field.limited_volume, 0);
    EXPECT_TRUE(result.report.field.limiting.empty());
    EXPECT_FALSE(warns_of_sizes(result));
  }
}

// A wall two sizes thick has points in its middle; larger sizes give fewer.
TEST(LimitedSizes, WallsBetweenLargeTrianglesFillAsSizesShrink) {
  std::size_t before = 12;
  for (const double part : {0.6, 0.55, 0.5, 0.45, 0.4, 0.35}) {
    const std::size_t now = mesh(plate(), with_size(0.125 * part)).report.tetrahedra;
    EXPECT_GT(now, before) << part;
    before = now;
  }
}

TEST(LimitedSizes, AreThoseOfTheSurfaceTimesAPowerOfTwo) {
  const Report::Field at_one = mesh(plate(), with_size(0.0625)).report.field;
  for (const int k : {-900, 800}) {
    Surface surface = plate();
    for (Point& p : surface.vertices)
      for (double& x : p) x = std::ldexp(x, k);
    const Report::Field field = mesh(surface.view(), with_size(std::ldexp(0.0625, k))).report.field;
    EXPECT_EQ(field.limited_volume, at_one.limited_volume);
    ASSERT_EQ(field.limiting.size(), at_one.limiting.size());
    for (std::size_t i = 0; i < field.limiting.size(); ++i) {
      EXPECT_EQ(field.limiting[i].facet, at_one.limiting[i].facet);
      EXPECT_EQ(field.limiting[i].bearable, std::ldexp(at_one.limiting[i].bearable, k));
      EXPECT_EQ(field.limiting[i].place[0], std::ldexp(at_one.limiting[i].place[0], k));
    }
  }
}

TEST(LimitedSizes, AreTheSameOnTwoThreads) {
  Options options = with_size(0.0625);
  const Report::Field one = mesh(plate(), options).report.field;
  options.threads = 2;
  const Report::Field two = mesh(plate(), options).report.field;
  EXPECT_EQ(one.limited_volume, two.limited_volume);
  EXPECT_EQ(one.limiting.size(), two.limiting.size());
}

}  // namespace
}  // namespace holdfast::limited_sizes_test
