// Quality, dihedral angles and the target (paper §8).
#include "mesh/quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>

#include "mesh/quality_below.h"
#include "mesh/shape_counts.h"
#include "mesh/target_quality.h"

namespace holdfast::quality_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const double kRoot3 = std::sqrt(3.0);
const Point kTop{0.5, kRoot3 / 6, std::sqrt(2.0 / 3)};
const Point kA{0, 0, 0}, kB{1, 0, 0}, kC{0.5, kRoot3 / 2, 0};

Point scaled(const Point& p, double factor) { return {p[0] * factor, p[1] * factor, p[2] * factor}; }

TEST(Quality, RegularIsOne) {
  EXPECT_NEAR(quality(kA, kB, kC, kTop), 1, 1e-14);
  for (const double angle : dihedral_angles(kA, kB, kC, kTop)) EXPECT_NEAR(angle, 70.528779365509308, 1e-11);
}

TEST(Quality, CornerOfACube) {
  const Point o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  // Longest edge sqrt 2, volume 1/6, area 3/2 + sqrt 3 / 2.
  EXPECT_NEAR(quality(o, x, y, z), std::sqrt(6.0) / 12 * std::sqrt(2.0) * (3 + kRoot3), 1e-14);
  const std::array<double, 6> angles = dihedral_angles(o, x, y, z);
  for (const std::size_t k : {0u, 1u, 2u}) EXPECT_NEAR(angles[k], 90, 1e-12);
  for (const std::size_t k : {3u, 4u, 5u})
    EXPECT_NEAR(angles[k], std::atan(std::sqrt(2.0)) * 180 / std::numbers::pi, 1e-12);
}

TEST(Quality, DoesNotDependOnScale) {
  for (const double factor : {0x1p-1000, 0x1p-500, 0x1p500, 0x1p1000}) {
    EXPECT_NEAR(quality(scaled(kA, factor), scaled(kB, factor), scaled(kC, factor), scaled(kTop, factor)), 1,
                1e-14);
    EXPECT_NEAR(best_quality_on(scaled(kA, factor), scaled(kB, factor), scaled(kC, factor)), 1, 1e-12);
    for (const double angle :
         dihedral_angles(scaled(kA, factor), scaled(kB, factor), scaled(kC, factor), scaled(kTop, factor)))
      EXPECT_NEAR(angle, 70.528779365509308, 1e-11);
  }
}

TEST(Quality, FlatIsInfinite) {
  const Point d{0.5, 0.25, 0};
  EXPECT_EQ(quality(kA, kB, kC, d), kInfinity);
  for (const double angle : dihedral_angles(kA, kB, kC, d)) EXPECT_TRUE(angle == 0 || angle == 180) << angle;
}

TEST(Quality, CornersThatShareADouble) {
  EXPECT_EQ(quality(kA, kB, kC, kC), kInfinity);
  EXPECT_EQ(quality(kA, kA, kA, kA), kInfinity);
  const std::array<double, 6> angles = dihedral_angles(kA, kB, kC, kC);
  EXPECT_FALSE(std::isnan(angles[0]));
  EXPECT_TRUE(std::isnan(angles[5]));
  EXPECT_EQ(best_quality_on(kA, kB, kB), kInfinity);
  Volume volume;
  volume.vertices = {kA, kB, kC, kC};
  volume.tetrahedra = {{0, 1, 2, 3}};
  const VolumeShape q = measure(volume);
  EXPECT_EQ(q.worst, kInfinity);
  EXPECT_EQ(q.min_dihedral_deg, 0);
  EXPECT_EQ(std::accumulate(q.dihedrals.begin(), q.dihedrals.end(), std::size_t{0}), 6u);
}

// A sliver far from the origin, of height h over an oblique plane: its terms cancel, and plain floating point
// has no correct digit of its volume.
TEST(Quality, SliversKeepTheirDigits) {
  const double far = 0x1p20;
  const double ulp = 0x1p-32;
  const Point a{far, far, far};
  const Point b{far + 1, far + 2, far + 3};
  const Point c{far + 2, far + 1, far + 5};
  // a + (b - a) / 2 + (c - a) / 4 lies in the plane; d is one step off it along x.
  const Point d{far + 1 + ulp, far + 1.25, far + 2.75};
  // det(b-a, c-a, d-a) = ulp * (2 * 5 - 3 * 1).
  const double six_volumes = 7 * ulp;
  const double longest = std::sqrt(4.0 + 1 + 25);
  const auto twice_area = [](Point u, Point v) {
    return std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
  };
  const double twice_areas = 2 * twice_area({1, 2, 3}, {2, 1, 5});  // d is over the inside of abc
  const double expected = std::sqrt(6.0) / 12 * longest * twice_areas / six_volumes;
  EXPECT_NEAR(quality(a, b, c, d) / expected, 1, 1e-6);
  // The angle at ab: height over the distance of d's foot from ab.
  const double height = six_volumes / twice_area({1, 2, 3}, {2, 1, 5});
  const double distance = twice_area({1, 2, 3}, {1, 1.25, 2.75}) / std::sqrt(14.0);
  EXPECT_NEAR(dihedral_angles(a, b, c, d)[0] / (height / distance * 180 / std::numbers::pi), 1, 1e-6);
}

// From regular to flat, with the fourth corner over the middle, over an edge and over a corner, and needles.
TEST(Quality, BelowALimitAgrees) {
  std::mt19937_64 random(3);
  const auto any = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  int told = 0, withheld = 0;
  for (int k = 0; k < 20000; ++k) {
    const double height = std::ldexp(any(), -static_cast<int>(random() % 60)),
                 width = std::ldexp(1.0, -static_cast<int>(random() % 20));
    const Point a{any(), any(), any()}, b{a[0] + 1, a[1] + any(), a[2]}, c{a[0] + any(), a[1] + width, a[2]},
        d{a[0] + any(), a[1] + width * any(), a[2] + height};
    const double q = quality(a, b, c, d);
    for (const double limit : {30.0, q * 0.9999, q, q * 1.0001, 1e6, kInfinity}) {
      const std::optional<double> below = quality_below(a, b, c, d, limit);
      ASSERT_EQ(below.has_value(), q < limit) << q << " " << limit;
      ASSERT_EQ(below.value_or(q), q);
      ASSERT_EQ(is_quality_below(a, b, c, d, limit), q < limit) << q << " " << limit;
      ++(below ? told : withheld);
    }
  }
  EXPECT_GT(told, 1000);
  EXPECT_GT(withheld, 1000);
}

TEST(Target, OfAnEquilateralTriangleIsOne) { EXPECT_NEAR(best_quality_on(kA, kB, kC), 1, 1e-12); }

TEST(Target, DoesNotDependOnTheOrder) {
  const Point a{0, 0, 0}, b{4, 1, 0}, c{1, 2, 0};
  const double q = best_quality_on(a, b, c);
  for (const double other : {best_quality_on(b, c, a), best_quality_on(c, b, a), best_quality_on(a, c, b)})
    EXPECT_NEAR(other, q, 1e-10);
}

TEST(Target, NeedlesKeepTheirDigits) {
  const double far = 0x1p20;
  const double step = 0x1p-30;
  const double near_origin = best_quality_on({0, 0, 0}, {1, 1, 1}, {0.5, 0.5, 0.5 + step});
  const double translated =
      best_quality_on({far, far, far}, {far + 1, far + 1, far + 1}, {far + 0.5, far + 0.5, far + 0.5 + step});
  EXPECT_NEAR(translated / near_origin, 1, 1e-9);
  EXPECT_GT(near_origin, 1e8);
}

// The derivation's last step, that the best apex makes an equilateral triangle with the longest side: a
// search over all apexes finds none better, and one as good.
class RandomTriangle : public ::testing::TestWithParam<unsigned> {};

TEST_P(RandomTriangle, NoApexIsBetter) {
  std::mt19937_64 random(GetParam());
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  const Point a{0, 0, 0}, b{1, 0, 0};
  const Point c{-0.2 + 1.4 * uniform(random), std::pow(10.0, -3 * uniform(random)), 0};
  const double target = best_quality_on(a, b, c);
  Point best{0.5, c[1] / 3, 0.8};
  double best_quality = quality(a, b, c, best);
  for (double step = 0.5; step > 1e-9;) {
    bool improved = false;
    for (int k = 0; k < 60; ++k) {
      const Point p{best[0] + step * normal(random), best[1] + step * normal(random),
                    best[2] + step * normal(random)};
      const double q = quality(a, b, c, p);
      ASSERT_GE(q, target * (1 - 1e-9)) << p[0] << ' ' << p[1] << ' ' << p[2];
      if (q >= best_quality) continue;
      best = p;
      best_quality = q;
      improved = true;
    }
    if (!improved) step *= 0.6;
  }
  EXPECT_NEAR(best_quality / target, 1, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomTriangle, ::testing::Range(1u, 41u));

TEST(Measure, CountsEveryAngleOnce) {
  Volume volume;
  volume.vertices = {kA, kB, kC, kTop, scaled(kTop, -1)};
  volume.vertices[4] = {kTop[0], kTop[1], -kTop[2]};
  volume.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  const std::vector<Triangle> facets{{0, 1, 3}, {1, 2, 3}};
  const VolumeShape q = measure(volume);
  EXPECT_NEAR(q.worst, 1, 1e-14);
  EXPECT_NEAR(target_quality(volume.vertices, facets), 1, 1e-12);
  EXPECT_NEAR(q.min_dihedral_deg, 70.5287793655, 1e-9);
  EXPECT_NEAR(q.max_dihedral_deg, 70.5287793655, 1e-9);
  EXPECT_EQ(q.dihedrals[7], 12u);
}

TEST(Measure, TargetIsTheWorstTriangles) {
  Volume volume;
  volume.vertices = {kA, kB, kC, {0.5, 0.01, 0}, {0.5, 0.1, 0}};
  const std::vector<Triangle> facets{{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const double worst = best_quality_on(kA, kB, volume.vertices[3]);
  EXPECT_NEAR(target_quality(volume.vertices, facets), worst, 1e-9 * worst);
  EXPECT_GT(worst, 40);
}

TEST(Measure, NothingIsZero) {
  const VolumeShape q = measure({});
  EXPECT_EQ(q.worst, 0);
  EXPECT_EQ(target_quality({}, {}), 0);
  EXPECT_EQ(q.min_dihedral_deg, 0);
  EXPECT_EQ(q.max_dihedral_deg, 0);
}

}  // namespace
}  // namespace holdfast::quality_test
