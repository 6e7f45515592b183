// Points near sides and facets.
#include "repair/near.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

#include "check_repair/reach.h"

namespace holdfast::repairing::near_test {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Exact = std::array<Rational, 3>;

Exact minus_exactly(const Point& a, const Point& b) {
  return {Rational(a[0]) - Rational(b[0]), Rational(a[1]) - Rational(b[1]), Rational(a[2]) - Rational(b[2])};
}
Exact cross_exactly(const Exact& a, const Exact& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Rational dot_exactly(const Exact& a, const Exact& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Of a point and the plane of a facet.
double distance_exactly(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Exact n = cross_exactly(minus_exactly(b, a), minus_exactly(c, a));
  const Rational along = dot_exactly(n, minus_exactly(p, a));
  return std::sqrt(static_cast<double>(Rational(along * along / dot_exactly(n, n))));
}

TEST(Near, TheDistanceFromASliverHasTheReportedUncertainty) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&](double size) {
    return Point{size * unit(random), size * unit(random), size * unit(random)};
  };
  int counted = 0, beyond_rounding = 0;
  for (int k = 0; k < 20'000; ++k) {
    const double height = std::exp2(-52 * std::fabs(unit(random))),
                 above = std::exp2(-52 * std::fabs(unit(random)));
    const Point a = vector(1), b = vector(1), aside = vector(height), up = vector(above);
    Point c{}, p{};
    for (std::size_t i = 0; i < 3; ++i) {
      c[i] = (a[i] + b[i]) / 2 + aside[i];
      p[i] = (a[i] + b[i] + c[i]) / 3 + up[i];
    }
    const Nearness near = beside_facet(p, a, b, c);
    if (!(near.distance < 1)) continue;
    ++counted;
    const double error = std::fabs(near.distance - distance_exactly(p, a, b, c)),
                 rounding = near.bound() - near.distance;
    EXPECT_LE(error, rounding + near.tilt);
    beyond_rounding += error > rounding;
  }
  EXPECT_GT(counted, 1000);
  EXPECT_GT(beyond_rounding, 10);
}

/// Facets of all shapes, down to slivers whose corners are a last bit off a line; points on them, at about
/// the given distance, and anywhere.
TEST(Near, FarFromFacetIsNeverTrueForANearPoint) {
  std::mt19937_64 random(11);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto vector = [&](double size) {
    return Point{between(-size, size), between(-size, size), between(-size, size)};
  };
  int near = 0, far = 0;
  for (int trial = 0; trial < 200'000; ++trial) {
    const double size = std::exp2(between(-60, 60)), width = size * std::exp2(between(-56, 0));
    const double distance = size * std::exp2(between(-54, -2)), away = distance * std::exp2(between(-2, 6));
    const Point a = vector(size), b = vector(size), aside = vector(width), off = vector(away);
    const double along = between(-1, 2), s = between(-1, 2), t = between(-1, 2);
    Point c{}, p{};
    for (std::size_t k = 0; k < 3; ++k) {
      c[k] = a[k] + along * (b[k] - a[k]) + aside[k];
      p[k] = a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]) + off[k];
    }
    const bool is_near = distance_to(p, a, b, c) <= distance;
    const bool is_far = FarFromFacet(a, b, c, distance)(p);
    EXPECT_FALSE(is_near && is_far);
    near += is_near;
    far += is_far;
  }
  EXPECT_GT(near, 10'000);
  EXPECT_GT(far, 50'000);
}

/// The normal of a sliver is uncertain, and so is the distance along it.
TEST(Near, BoundsAreNeverBelowTheDistanceFromAFacet) {
  std::mt19937_64 random(5);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto vector = [&](double size) {
    return Point{between(-size, size), between(-size, size), between(-size, size)};
  };
  int beside = 0;
  for (int trial = 0; trial < 100'000; ++trial) {
    const double width = std::exp2(between(-50, 0)), away = std::exp2(between(-54, 0));
    const Point a = vector(1), b = vector(1), aside = vector(width), off = vector(away);
    Point c{}, p{};
    const double s = between(0, 0.5), t = between(0, 0.5), along = between(-1, 2);
    for (std::size_t k = 0; k < 3; ++k) {
      c[k] = a[k] + along * (b[k] - a[k]) + aside[k];
      p[k] = a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]) + off[k];
    }
    const Nearness near = beside_facet(p, a, b, c);
    if (!std::isfinite(near.distance)) continue;
    ++beside;
    EXPECT_TRUE(checking::Reach(near.bound()).of_triangle(p, {a, b, c})) << near.distance;
  }
  EXPECT_GT(beside, 10'000);
}

TEST(Near, FarFromFacetIsFalseWithoutAreaOrBeyondTheRangeOfProducts) {
  const Point a{0, 0, 0}, b{1, 1, 1};
  EXPECT_FALSE(FarFromFacet(a, a, a, 0.1)({0, 0, 0.05}));
  EXPECT_FALSE(FarFromFacet(a, b, b, 0.1)({0.5, 0.5, 0.55}));
  EXPECT_FALSE(FarFromFacet({1e200, 0, 0}, {0, 1e200, 0}, {0, 0, 1e200}, 1)({0, 0, 1e200}));
}

}  // namespace
}  // namespace holdfast::repairing::near_test
