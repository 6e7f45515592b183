// The desired size at a point: close to the least over the whole surface, and found without examining all of
// it.
#include "divide/wanted_size.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

#include "numbers/vector.h"

namespace holdfast::division::wanted_size_test {
namespace {

constexpr double kGradation = 0.3, kLength = 0.01;

/// Short segments all over the unit sphere, along its radii.
Surface pins(int count) {
  Surface surface;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z), turn = 2.399963229728653 * i;
    const Point p{r * std::cos(turn), r * std::sin(turn), z};
    const auto n = static_cast<Index>(surface.vertices.size());
    surface.vertices.push_back(p);
    surface.vertices.push_back({p[0] * (1 + kLength), p[1] * (1 + kLength), p[2] * (1 + kLength)});
    surface.segments.push_back({n, n + 1});
  }
  return surface;
}

double least_at(const Surface& surface, const Point& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Point& v : surface.vertices) least = std::min(least, kLength + kGradation * distance(v, p));
  return least;
}

std::vector<Point> places() {
  std::vector<Point> places;
  for (int i = 0; i < 100; ++i) places.push_back({0.001 * i - 0.05, 0.0003 * i, 0.01});
  for (int i = 0; i < 100; ++i) places.push_back({0.015 * i, 0.01, -0.3});
  return places;
}

TEST(WantedSize, IsNearTheLeast) {
  const Surface surface = pins(2000);
  const WantedSize wanted(surface.view(), kGradation, {});
  for (const Point& p : places()) {
    const double least = least_at(surface, p), found = wanted(p);
    EXPECT_GE(found, least * (1 - 1e-9));
    EXPECT_LE(found, least * (1 + 1.0 / 9 + 1e-9));
  }
}

// All of the sphere is about as far from its middle.
TEST(WantedSize, InTheMiddleOfABallDoesNotExamineAllOfIt) {
  const Surface surface = pins(40000);
  const WantedSize wanted(surface.view(), kGradation, {});
  double sum = 0;
  const std::clock_t start = std::clock();
  for (int i = 0; i < 50; ++i) sum += wanted(places()[static_cast<std::size_t>(i)]);
  const std::clock_t between = std::clock();
  for (int i = 0; i < 50; ++i) sum += least_at(surface, places()[static_cast<std::size_t>(i)]);
  const std::clock_t end = std::clock();
  EXPECT_GT(sum, 0);
  EXPECT_LT(between - start, (end - between) / 2);
}

}  // namespace
}  // namespace holdfast::division::wanted_size_test
