// The stored-sphere filter of cell.h against the exact predicates: where it decides, it is right, on nearly
// degenerate input at every scale; and it nearly always decides on input in general position.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "delaunay/cell.h"
#include "exact/predicates.h"
#include "holdfast/types.h"

namespace holdfast::delaunay_filter_test {
namespace {

using Random = std::mt19937_64;

struct Tally {
  std::size_t decided = 0, undecided = 0, wrong = 0;
  void add(const Filtered& test, int sign) {
    if (!test.decided) {
      ++undecided;
      return;
    }
    ++decided;
    if (sign == 0 || (test.f < 0) != (sign > 0)) ++wrong;
  }
};

Filtered ask(const Cell& cell, const Point& base, const Point& q) {
  return filtered_conflict(cell, base.data(), q[0], q[1], q[2]);
}

// The sphere of a positive tetrahedron, from each of the two lanes.
std::array<Cell, 2> spheres(const std::array<Point, 4>& p) {
  std::array<Cell, 2> cells{};
  const Spoke u = spoke(p[0].data(), p[1].data());
  const Spoke v = spoke(p[0].data(), p[2].data());
  const Spoke w = spoke(p[0].data(), p[3].data());
  set_spheres({&cells[0], &cells[1]}, {&u, &u}, {&v, &v}, {&w, &w});
  return cells;
}

bool make_positive(std::array<Point, 4>& p) {
  const int sign = exact::orient3d(p[0].data(), p[1].data(), p[2].data(), p[3].data());
  if (sign < 0) std::swap(p[0], p[1]);
  return sign != 0;
}

void compare_sphere(std::array<Point, 4> p, const Point& q, Tally& tally) {
  if (!make_positive(p)) return;
  const int sign = exact::insphere(p[0].data(), p[1].data(), p[2].data(), p[3].data(), q.data());
  for (const Cell& cell : spheres(p)) tally.add(ask(cell, p[0], q), sign);
}

void compare_half_space(const std::array<Point, 4>& p, const Point& q, Tally& tally) {
  Point low = q, high = q;
  for (const Point& x : p)
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], x[i]);
      high[i] = std::max(high[i], x[i]);
    }
  Cell cell{};
  set_half_space(cell, spoke(p[0].data(), p[1].data()), spoke(p[0].data(), p[2].data()),
                 (high[0] - low[0]) + (high[1] - low[1]) + (high[2] - low[2]));
  tally.add(ask(cell, p[0], q), exact::orient3d(p[0].data(), p[1].data(), p[2].data(), q.data()));
}

double step(double x, int ulps) {
  for (; ulps > 0; --ulps) x = std::nextafter(x, std::numeric_limits<double>::infinity());
  for (; ulps < 0; ++ulps) x = std::nextafter(x, -std::numeric_limits<double>::infinity());
  return x;
}

TEST(DelaunayFilter, DecidesGeneralPosition) {
  Random random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&] { return Point{coordinate(random), coordinate(random), coordinate(random)}; };
  Tally sphere, half_space;
  for (int i = 0; i < 20000; ++i) {
    const std::array<Point, 4> p{point(), point(), point(), point()};
    const Point q = point();
    compare_sphere(p, q, sphere);
    compare_half_space(p, q, half_space);
  }
  EXPECT_EQ(sphere.wrong, 0u);
  EXPECT_EQ(half_space.wrong, 0u);
  EXPECT_LE(sphere.undecided, 10u);
  EXPECT_LE(half_space.undecided, 10u);
}

// Points of a coarse grid, moved by a few ulps: cospherical and coplanar except for the last bits.
TEST(DelaunayFilter, RightNearDegeneracyAtEveryScale) {
  Random random(2);
  std::uniform_int_distribution<int> grid(0, 4), ulps(-2, 2), exponent(-70, 70);
  Tally sphere, half_space;
  for (int i = 0; i < 200000; ++i) {
    const double scale = std::ldexp(1.0, exponent(random));
    const double shift = i % 3 == 0 ? 0 : i % 3 == 1 ? 1 : 1000;
    const auto point = [&] {
      Point p{};
      for (double& x : p) x = step((grid(random) + shift) * scale, i % 2 == 0 ? ulps(random) : 0);
      return p;
    };
    const std::array<Point, 4> p{point(), point(), point(), point()};
    const Point q = point();
    compare_sphere(p, q, sphere);
    compare_half_space(p, q, half_space);
  }
  EXPECT_EQ(sphere.wrong, 0u);
  EXPECT_EQ(half_space.wrong, 0u);
  EXPECT_GT(sphere.decided, 10000u);
  EXPECT_GT(sphere.undecided, 10000u);
  EXPECT_GT(half_space.decided, 10000u);
  EXPECT_GT(half_space.undecided, 10000u);
}

// A needle or a sliver, and a query close to its sphere: the bound depends on the shape.
TEST(DelaunayFilter, RightForBadShapes) {
  Random random(3);
  std::normal_distribution<double> gauss;
  std::uniform_int_distribution<int> power(-45, 0), ulps(-3, 3);
  Tally tally;
  for (int i = 0; i < 200000; ++i) {
    const auto on_sphere = [&](double spread) {
      const Point d{1, spread * gauss(random), spread * gauss(random)};
      const double r = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      Point p{};
      for (std::size_t k = 0; k < 3; ++k) p[k] = step(d[k] / r, ulps(random));
      return p;
    };
    const double spread = std::ldexp(1.0, power(random));
    const std::array<Point, 4> p{on_sphere(spread), on_sphere(spread), on_sphere(spread), on_sphere(1)};
    compare_sphere(p, on_sphere(i % 2 == 0 ? spread : 1), tally);
  }
  EXPECT_EQ(tally.wrong, 0u);
  EXPECT_GT(tally.undecided, 1000u);
}

// Differences and products beyond the range of doubles: undecided or right, never wrong.
TEST(DelaunayFilter, RightAtTheEndsOfTheRange) {
  Random random(4);
  std::uniform_int_distribution<int> grid(-3, 3), exponent(-1074, 1021);
  Tally sphere, half_space;
  for (int i = 0; i < 40000; ++i) {
    const bool one_scale = i % 2 == 0;
    const int common = exponent(random);
    const auto point = [&] {
      Point p{};
      for (double& x : p) x = std::ldexp(grid(random), one_scale ? common : exponent(random));
      return p;
    };
    const std::array<Point, 4> p{point(), point(), point(), point()};
    const Point q = point();
    compare_sphere(p, q, sphere);
    compare_half_space(p, q, half_space);
  }
  EXPECT_EQ(sphere.wrong, 0u);
  EXPECT_EQ(half_space.wrong, 0u);
}

}  // namespace
}  // namespace holdfast::delaunay_filter_test
