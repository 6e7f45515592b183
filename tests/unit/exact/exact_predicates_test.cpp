// Predicates on chosen points: sign conventions, the tier that decides, extreme magnitudes.
#include <gtest/gtest.h>

#include <limits>

#include "exact/predicates.h"
#include "exact/tiers.h"
#include "exact_reference.h"

namespace holdfast::exact::test::exact_predicates_test {
namespace {

using detail::Tier;

const Point3 kOrigin = {0, 0, 0}, kX = {1, 0, 0}, kY = {0, 1, 0}, kZ = {0, 0, 1};

int orient(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  return orient3d(a.data(), b.data(), c.data(), d.data());
}

int sphere(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& e) {
  return insphere(a.data(), b.data(), c.data(), d.data(), e.data());
}

Tier orient_tier(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  if (detail::orient3d_filter(a.data(), b.data(), c.data(), d.data()) != 0) return Tier::filter;
  return detail::decide_orient3d(a.data(), b.data(), c.data(), d.data()).tier;
}

Tier sphere_tier(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& e) {
  if (detail::insphere_filter(a.data(), b.data(), c.data(), d.data(), e.data()) != 0) return Tier::filter;
  return detail::decide_insphere(a.data(), b.data(), c.data(), d.data(), e.data()).tier;
}

TEST(Predicates, Orient3dSign) {
  EXPECT_EQ(orient(kOrigin, kX, kY, kZ), 1);
  EXPECT_EQ(orient(kOrigin, kY, kX, kZ), -1);
  EXPECT_EQ(orient(kOrigin, kX, kY, {3, 4, 0}), 0);
}

TEST(Predicates, Orient2dSign) {
  const double o[] = {0, 0}, x[] = {1, 0}, y[] = {0, 1}, far[] = {2, 0};
  EXPECT_EQ(orient2d(o, x, y), 1);
  EXPECT_EQ(orient2d(o, y, x), -1);
  EXPECT_EQ(orient2d(o, x, far), 0);
}

TEST(Predicates, Orient2dProjectsCyclically) {
  const PointRef o{kOrigin.data()}, x{kX.data()}, y{kY.data()}, z{kZ.data()};
  EXPECT_EQ(orient2d(o, x, y, 2), 1);
  EXPECT_EQ(orient2d(o, y, z, 0), 1);
  EXPECT_EQ(orient2d(o, z, x, 1), 1);
  EXPECT_EQ(orient2d(o, x, y, 0), 0);
}

TEST(Predicates, InsphereSign) {
  EXPECT_EQ(sphere(kOrigin, kX, kY, kZ, {0.5, 0.5, 0.5}), 1);
  EXPECT_EQ(sphere(kOrigin, kX, kY, kZ, {1, 1, 1}), 0);
  EXPECT_EQ(sphere(kOrigin, kX, kY, kZ, {1, 1, std::nextafter(1, 2)}), -1);
  EXPECT_EQ(sphere(kOrigin, kX, kY, kZ, {1, 1, std::nextafter(1, 0)}), 1);
  EXPECT_EQ(sphere(kOrigin, kY, kX, kZ, {0.5, 0.5, 0.5}), -1);
  EXPECT_EQ(sphere(kOrigin, kX, kY, kZ, {9, 9, 9}), -1);
}

TEST(PredicateTiers, Orient3dOfDoubles) {
  EXPECT_EQ(orient_tier(kOrigin, kX, kY, kZ), Tier::filter);
  EXPECT_EQ(orient_tier(kOrigin, kX, kY, {0.1, 0.3, 0}), Tier::integer64);
  EXPECT_EQ(orient_tier({0, 0, 0x1p-80}, {1, 0, 0x1p-80}, {0, 1, 0x1p-80}, {1, 1, 0x1p-80}),
            Tier::integer128);
  EXPECT_EQ(orient_tier({0, 0, 0x1p-200}, {1, 0, 0x1p-200}, {0, 1, 0x1p-200}, {1, 1, 0x1p-200}),
            Tier::expansion);
  EXPECT_EQ(orient_tier({0, 0, 0x1p-400}, {1, 0, 0x1p-400}, {0, 1, 0x1p-400}, {1, 1, 0x1p-400}),
            Tier::big_integer);
}

TEST(PredicateTiers, Orient2dOfDoubles) {
  const auto tier = [](double height) {
    const double a[] = {0, height}, b[] = {1, height}, c[] = {3, height};
    EXPECT_EQ(orient2d(a, b, c), 0);
    return detail::decide_orient2d(a, b, c).tier;
  };
  EXPECT_EQ(tier(1), Tier::integer64);
  EXPECT_EQ(tier(0x1p-80), Tier::integer128);
  EXPECT_EQ(tier(0x1p-200), Tier::expansion);
  EXPECT_EQ(tier(0x1p-600), Tier::big_integer);
}

TEST(PredicateTiers, InsphereOfDoubles) {
  const auto tier = [](double unit, double small) {
    const Point3 a = {0, 0, small}, b = {unit, 0, small}, c = {0, unit, small}, d = {0, 0, unit};
    const Point3 e = {unit, unit, small};
    EXPECT_EQ(sphere(a, b, c, d, e), 0);
    return sphere_tier(a, b, c, d, e);
  };
  EXPECT_EQ(sphere_tier(kOrigin, kX, kY, kZ, {0.5, 0.5, 0.5}), Tier::filter);
  EXPECT_EQ(tier(1, 0), Tier::integer64);
  EXPECT_EQ(tier(1, 0x1p-80), Tier::integer128);
  EXPECT_EQ(tier(1, 0x1p-150), Tier::big_integer);  // 1 - 2^-150 is no double
  // Here all differences are doubles.
  EXPECT_EQ(sphere_tier({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0x1p-150}, {1, 1, 0}), Tier::expansion);
  EXPECT_EQ(sphere({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0x1p-150}, {1, 1, 0}), 0);
  EXPECT_EQ(tier(0x1p-970, 0), Tier::integer128);  // the scaled units of one limb would overflow
}

TEST(PredicateTiers, ExactPoints) {
  const auto tier = [](std::int64_t depth) {
    // Collinear points on the diagonal, one of them 2^-depth short of the middle.
    const MadePoint p = between({0, 0, 0}, {1, 1, 1}, Dyadic(0.5) - Dyadic(1).scaled(-depth));
    const PointRef o{kOrigin.data()}, x{kX.data()};
    const Point3 y_and_z = {0, 1, 1};
    const PointRef plane{y_and_z.data()};
    EXPECT_EQ(orient3d(o, x, plane, p.ref()), 0);
    return detail::decide_orient3d(o, x, plane, p.ref()).tier;
  };
  EXPECT_EQ(tier(20), Tier::integer64);
  EXPECT_EQ(tier(100), Tier::integer128);
  EXPECT_EQ(tier(180), Tier::integer192);
  EXPECT_EQ(tier(240), Tier::integer256);
  EXPECT_EQ(tier(2000), Tier::big_integer);
}

TEST(PredicateTiers, TheFilterForManyPointsDecidesWhatTheOtherDoes) {
  const OrientFilter of_z_plane(kOrigin.data(), kX.data(), kY.data());
  for (const double z : {1e-300, 1e-15, 1.0, 1e100}) {
    const Point3 above = {0.3, 0.4, z}, below = {0.3, 0.4, -z};
    EXPECT_EQ(of_z_plane(above.data()),
              detail::orient3d_filter(kOrigin.data(), kX.data(), kY.data(), above.data()));
    EXPECT_EQ(of_z_plane(below.data()), -of_z_plane(above.data()));
  }
  const Point3 on = {0.3, 0.4, 0};
  EXPECT_EQ(of_z_plane(kZ.data()), 1);
  EXPECT_EQ(of_z_plane(on.data()), 0);
}

TEST(PredicateTiers, FilterDecidesWhatIsFarFromDegenerate) {
  Random random(5);
  int orients = 0, spheres = 0, mixed = 0;
  constexpr int kCalls = 10000;
  for (int i = 0; i < kCalls; ++i) {
    std::array<Point3, 5> p;
    for (Point3& q : p) {
      for (double& x : q) x = uniform(random, 1, 2);
    }
    orients += detail::orient3d_filter(p[0].data(), p[1].data(), p[2].data(), p[3].data()) != 0;
    spheres += detail::insphere_filter(p[0].data(), p[1].data(), p[2].data(), p[3].data(), p[4].data()) != 0;
    mixed += detail::orient3d_mixed_filter(p[0].data(), p[1].data(), p[2].data(), p[3].data()) != 0;
  }
  EXPECT_EQ(orients, kCalls);
  EXPECT_EQ(spheres, kCalls);
  EXPECT_EQ(mixed, kCalls);
}

TEST(Predicates, TranslationBeyondTheMantissa) {
  // Coordinates on the grid of doubles near 2^52: differences of one ulp.
  const double k = 0x1p52;
  const Point3 a = {k, k, k}, b = {k + 1, k, k}, c = {k, k + 1, k}, d = {k, k, k + 1};
  EXPECT_EQ(orient(a, b, c, d), 1);
  EXPECT_EQ(sphere(a, b, c, d, {k + 1, k + 1, k + 1}), 0);
}

TEST(Predicates, LargestAndSmallestDoubles) {
  const double big = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(orient({-big, -big, -big}, {big, -big, -big}, {-big, big, -big}, {-big, -big, big}), 1);
  EXPECT_EQ(orient({0, 0, 0}, {least, 0, 0}, {0, least, 0}, {0, 0, least}), 1);
  EXPECT_EQ(orient({0, 0, 0}, {least, 0, 0}, {0, least, 0}, {0, 0, big}), 1);
  EXPECT_EQ(orient({0, 0, 0}, {least, 0, 0}, {0, big, 0}, {0, 0, big}), 1);
  EXPECT_EQ(
      sphere({-big, -big, -big}, {big, -big, -big}, {-big, big, -big}, {-big, -big, big}, {big, big, big}),
      0);
  EXPECT_EQ(sphere({0, 0, 0}, {least, 0, 0}, {0, least, 0}, {0, 0, least}, {least, least, 0}), 0);
  EXPECT_EQ(sphere({0, 0, 0}, {least, 0, 0}, {0, least, 0}, {0, 0, least}, {2 * least, 0, 0}), -1);
  const double low[] = {-big, -big}, right[] = {big, -big}, high[] = {-big, big};
  EXPECT_EQ(orient2d(low, right, high), 1);
  const double zero[] = {0, 0}, u[] = {least, 0}, v[] = {0, least};
  EXPECT_EQ(orient2d(zero, u, v), 1);
}

TEST(Predicates, ExactPointsThatShareOneDouble) {
  // Slightly above, in and below the plane z = 1/3 (as a double), all with the same approximation.
  const double third = 1.0 / 3;
  const Point3 a = {0, 0, third}, b = {1, 0, third}, c = {0, 1, third}, approx = {0.25, 0.25, third};
  for (const int side : {-1, 0, 1}) {
    ExactPoint p = lift(approx.data());
    p.c[2] += Dyadic(side).scaled(-150);
    const PointRef ref{approx.data(), &p};
    EXPECT_EQ(orient3d(PointRef{a.data()}, PointRef{b.data()}, PointRef{c.data()}, ref), side);
    EXPECT_EQ(orient2d(PointRef{a.data()}, PointRef{b.data()}, ref, 1), -side);
  }
}

TEST(Point, DifferenceSurvivesCancellation) {
  const Point3 p = {1, 0.1, 1e-300};
  ExactPoint e = lift(p.data());
  e.c[0] += Dyadic(3).scaled(-200);
  e.c[1] += Dyadic(1).scaled(-60);
  e.c[2] += Dyadic(1).scaled(-1100);
  const MadePoint moved = [&] {
    MadePoint result{e, {}};
    round(result);
    return result;
  }();
  double out[3];
  difference(moved.ref(), PointRef{p.data()}, out);
  EXPECT_EQ(out[0], 3 * 0x1p-200);
  EXPECT_EQ(out[1], 0x1p-60);
  EXPECT_EQ(out[2], 0.0);  // 2^-1100 is below half the least denormal
  difference(moved.ref(), moved.ref(), out);
  EXPECT_EQ(out[0], 0);
  const Point3 q = {3, 5, 7};
  difference(PointRef{q.data()}, PointRef{p.data()}, out);
  EXPECT_EQ(out[1], 5 - 0.1);
}

}  // namespace
}  // namespace holdfast::exact::test::exact_predicates_test
