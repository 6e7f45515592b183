// Predicates against rationals on nearly degenerate points; all tiers must agree; the numbered laws.
#include <gtest/gtest.h>

#include <map>
#include <optional>

#include "exact/orient_among.h"
#include "exact/orient_ring.h"
#include "exact/predicates.h"
#include "exact/tiers.h"
#include "exact_reference.h"

namespace holdfast::exact::test::exact_predicates_law_test {
namespace {

using detail::Tier;

std::string describe(const Case& c) {
  std::string text = c.kind;
  char buffer[128];
  for (const Point3& p : c.p) {
    std::snprintf(buffer, sizeof buffer, "\n  {%a, %a, %a}", p[0], p[1], p[2]);
    text += buffer;
  }
  return text;
}

/// The answer of one tier; nullopt if it declines.
void expect_agrees(std::optional<int> answer, int truth, const char* tier, const Case& c) {
  if (answer) {
    EXPECT_EQ(*answer, truth) << tier << " on " << describe(c);
  }
}

/// A filter may answer 0 (undecided), but never the wrong sign.
void expect_sound(int answer, int truth, const char* filter, const Case& c) {
  if (answer != 0) {
    EXPECT_EQ(answer, truth) << filter << " on " << describe(c);
  }
}

/// Signs of the first three of some points with each of all, if the filter decides: none is wrong. Returns
/// how many signs of points that are not coplanar it leaves open.
std::size_t left_open(const std::vector<Point3>& points, const Case& c) {
  const OrientAmong filter(points.size(), [&](std::size_t k) { return points[k].data(); });
  const OrientAmong::Signs signs = filter.of_all(0, 1, 2);
  std::size_t open = 0;
  for (std::size_t k = 0; k < OrientAmong::kMost; ++k) {
    const int answer = static_cast<int>(signs.positive >> k & 1) - static_cast<int>(signs.negative >> k & 1);
    const int truth = k < points.size()
                          ? orient3d(points[0].data(), points[1].data(), points[2].data(), points[k].data())
                          : 0;
    EXPECT_EQ(signs.positive >> k & signs.negative >> k & 1, 0U);
    expect_sound(answer, truth, "filter among many", c);
    if (answer == 0 && truth != 0) ++open;
  }
  return open;
}

TEST(PredicateLaw, TheFilterAmongManyPointsIsSound) {
  Random random(22);
  for (int i = 0; i < 2000; ++i) {
    // From one case, and from several of different sizes.
    std::vector<Case> cases(1 + random() % (OrientAmong::kMost / 5));
    std::vector<Point3> points;
    for (Case& c : cases) {
      c = random_case(random);
      points.insert(points.end(), c.p.begin(), c.p.end());
    }
    left_open(points, cases.front());
  }
}

TEST(PredicateLaw, TheFilterAmongManyPointsLeavesLittleOpen) {
  Random random(23);
  std::size_t open = 0;
  for (int i = 0; i < 1000; ++i) {
    std::vector<Point3> points(OrientAmong::kMost);
    for (Point3& p : points)
      for (double& x : p) x = uniform(random, -1, 1);
    open += left_open(points, {"uniform", {}});
  }
  EXPECT_LT(open, 10u);
}

// All triangles of a ring, with the ring and its two ends. Returns how many nonzero signs the filter leaves
// open.
std::size_t left_open_in_ring(const std::vector<Point3>& points, const Case& c) {
  const double *a = points.front().data(), *b = points.back().data();
  const std::size_t n = points.size() - 2;
  const auto at = [&](std::size_t i) { return points[1 + i % n].data(); };
  OrientRing ring;
  ring.set(n, at, a, b);
  std::size_t open = 0;
  const auto expect = [&](const OrientRing::Signs& signs, std::size_t bit, int truth) {
    const int answer =
        static_cast<int>(signs.positive >> bit & 1) - static_cast<int>(signs.negative >> bit & 1);
    EXPECT_EQ(signs.positive >> bit & signs.negative >> bit & 1, 0U);
    expect_sound(answer, truth, "filter in a ring", c);
    if (answer == 0 && truth != 0) ++open;
  };
  for (const OrientRing::OfBoth& ears : {ring.ears(), ring.ears_by_pairs()}) {
    for (std::size_t i = 0; i < n; ++i) {
      expect(ears.a, i, orient3d(at(i + n - 1), at(i), at(i + 1), a));
      expect(ears.b, i, orient3d(at(i + n - 1), at(i), at(i + 1), b));
    }
    EXPECT_EQ((ears.a.positive | ears.a.negative | ears.b.positive | ears.b.negative) >> n, 0U);
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) {
      const OrientRing::Signs signs = ring.triangle(i, k, (i + k + 1) % n);
      expect(signs, 0, orient3d(at(i), at(k), at(i + k + 1), a));
      expect(signs, 1, orient3d(at(i), at(k), at(i + k + 1), b));
    }
  return open;
}

TEST(PredicateLaw, TheFilterInARingIsSound) {
  Random random(24);
  for (int i = 0; i < 2000; ++i) {
    std::vector<Case> cases(1 + random() % (OrientRing::kMost / 5));
    std::vector<Point3> points;
    for (Case& c : cases) {
      c = random_case(random);
      points.insert(points.end(), c.p.begin(), c.p.end());
    }
    left_open_in_ring(points, cases.front());
  }
}

TEST(PredicateLaw, TheFilterInARingLeavesLittleOpen) {
  Random random(25);
  std::size_t open = 0;
  for (int i = 0; i < 1000; ++i) {
    std::vector<Point3> points(5 + random() % (OrientRing::kMost - 2));
    for (Point3& p : points)
      for (double& x : p) x = uniform(random, -1, 1);
    open += left_open_in_ring(points, {"uniform", {}});
  }
  EXPECT_LT(open, 10u);
}

TEST(PredicateLaw, Orient3dTiersAgreeWithRationals) {
  Random random(21);
  std::map<Tier, int> decided;
  for (int i = 0; i < 10000; ++i) {
    const Case c = random_case(random);
    const double *p = c.p[0].data(), *q = c.p[1].data(), *r = c.p[2].data(), *s = c.p[3].data();
    const int truth = reference_orient3d({p}, {q}, {r}, {s});
    expect_sound(detail::orient3d_filter(p, q, r, s), truth, "filter", c);
    expect_sound(OrientFilter(p, q, r)(s), truth, "filter for many", c);
    expect_sound(detail::orient3d_mixed_filter(p, q, r, s), truth, "mixed filter", c);
    expect_agrees(detail::integer_orient3d<1>(p, q, r, s), truth, "integer64", c);
    expect_agrees(detail::integer_orient3d<2>(p, q, r, s), truth, "integer128", c);
    expect_agrees(detail::expansion_orient3d(p, q, r, s), truth, "expansion", c);
    expect_agrees(detail::big_orient3d({p}, {q}, {r}, {s}), truth, "big", c);
    expect_agrees(orient3d(p, q, r, s), truth, "orient3d", c);
    ++decided[detail::decide_orient3d(p, q, r, s).tier];
  }
  for (const Tier tier : {Tier::integer64, Tier::integer128, Tier::expansion, Tier::big_integer}) {
    EXPECT_GT(decided[tier], 100) << "tier " << static_cast<int>(tier) << " is hardly tested";
  }
}

TEST(PredicateLaw, InsphereTiersAgreeWithRationals) {
  Random random(22);
  std::map<Tier, int> decided;
  for (int i = 0; i < 3000; ++i) {
    const Case c = random_case(random);
    const double *p = c.p[0].data(), *q = c.p[1].data(), *r = c.p[2].data(), *s = c.p[3].data(),
                 *t = c.p[4].data();
    const int truth = reference_insphere(c.p[0], c.p[1], c.p[2], c.p[3], c.p[4]);
    expect_sound(detail::insphere_filter(p, q, r, s, t), truth, "filter", c);
    expect_agrees(detail::integer_insphere<1>(p, q, r, s, t), truth, "integer64", c);
    expect_agrees(detail::integer_insphere<2>(p, q, r, s, t), truth, "integer128", c);
    expect_agrees(detail::expansion_insphere(p, q, r, s, t), truth, "expansion", c);
    expect_agrees(detail::big_insphere(p, q, r, s, t), truth, "big", c);
    expect_agrees(insphere(p, q, r, s, t), truth, "insphere", c);
    ++decided[detail::decide_insphere(p, q, r, s, t).tier];
  }
  for (const Tier tier : {Tier::integer64, Tier::integer128, Tier::expansion, Tier::big_integer}) {
    EXPECT_GT(decided[tier], 50) << "tier " << static_cast<int>(tier) << " is hardly tested";
  }
}

TEST(PredicateLaw, InsphereMeansTheSphere) {
  Random random(23);
  for (int i = 0; i < 800; ++i) {
    const Case c = random_case(random);
    const auto& p = c.p;
    if (reference_orient3d({p[0].data()}, {p[1].data()}, {p[2].data()}, {p[3].data()}) == 0) continue;
    EXPECT_EQ(insphere(p[0].data(), p[1].data(), p[2].data(), p[3].data(), p[4].data()),
              reference_insphere_by_centre(p[0], p[1], p[2], p[3], p[4]))
        << describe(c);
  }
}

TEST(PredicateLaw, Orient2dTiersAgreeWithRationals) {
  Random random(24);
  std::map<Tier, int> decided;
  for (int i = 0; i < 3000; ++i) {
    const Case c = random_case(random);
    for (int axis = 0; axis < 3; ++axis) {
      const PointRef p{c.p[0].data()}, q{c.p[1].data()}, r{c.p[2].data()};
      const int truth = reference_orient2d(p, q, r, axis);
      const auto x = static_cast<std::size_t>((axis + 1) % 3), y = static_cast<std::size_t>((axis + 2) % 3);
      const double a[] = {c.p[0][x], c.p[0][y]}, b[] = {c.p[1][x], c.p[1][y]}, d[] = {c.p[2][x], c.p[2][y]};
      expect_sound(detail::orient2d_filter(a[0], a[1], b[0], b[1], d[0], d[1]), truth, "filter", c);
      expect_agrees(detail::integer_orient2d<1>(a, b, d), truth, "integer64", c);
      expect_agrees(detail::integer_orient2d<2>(a, b, d), truth, "integer128", c);
      expect_agrees(detail::expansion_orient2d(a, b, d), truth, "expansion", c);
      expect_agrees(detail::big_orient2d(p, q, r, axis), truth, "big", c);
      expect_agrees(orient2d(a, b, d), truth, "orient2d", c);
      expect_agrees(orient2d(p, q, r, axis), truth, "orient2d projected", c);
      ++decided[detail::decide_orient2d(a, b, d).tier];
    }
  }
  for (const Tier tier : {Tier::integer64, Tier::integer128, Tier::expansion, Tier::big_integer}) {
    EXPECT_GT(decided[tier], 100) << "tier " << static_cast<int>(tier) << " is hardly tested";
  }
}

/// Four points, some exact: on segments or in planes of the case's points, so that degeneracy is common.
struct MixedCase {
  Case base;
  std::array<MadePoint, 4> made;
  std::array<PointRef, 4> p;
};

void make_mixed(Random& random, MixedCase& c) {
  static constexpr int kBits[] = {1, 8, 41, 60, 106, 150, 200, 400};
  do {
    c.base = random_case(random);
  } while (c.base.kind == "huge" || c.base.kind == "extremes" || c.base.kind == "any exponent" ||
           c.base.kind == "underflow times overflow");  // their exact points leave the range of doubles
  const auto& b = c.base.p;
  for (std::size_t k = 0; k < 4; ++k) {
    const int bits = kBits[integer(random, 0, 7)];
    const auto u = random_fraction(random, bits), v = random_fraction(random, bits);
    switch (integer(random, 0, 3)) {
      case 0:
        c.made[k] = between(b[k], b[k + 1], u);
        break;
      case 1:
        c.made[k] = in_plane(b[0], b[1], b[2], u, v);
        break;
      case 2:
        c.made[k] = in_plane(b[0], b[1], b[2], u, v);
        c.made[k].exact.c[2] += Dyadic(integer(random, -1, 1)).scaled(-integer(random, 50, 300));
        round(c.made[k]);
        break;
      default:
        c.made[k] = {lift(b[k].data()), b[k]};
    }
    c.p[k] = integer(random, 0, 3) == 0 ? PointRef{b[k].data()} : c.made[k].ref();
  }
}

TEST(PredicateLaw, MixedOrient3dAgreesWithRationals) {
  Random random(25);
  std::map<Tier, int> decided;
  MixedCase c;
  for (int i = 0; i < 5000; ++i) {
    make_mixed(random, c);
    const auto [p, q, r, s] = c.p;
    const int truth = reference_orient3d(p, q, r, s);
    expect_sound(detail::orient3d_mixed_filter(p.approx, q.approx, r.approx, s.approx), truth, "filter",
                 c.base);
    expect_agrees(detail::integer_orient3d<1>(p, q, r, s), truth, "integer64", c.base);
    expect_agrees(detail::integer_orient3d<2>(p, q, r, s), truth, "integer128", c.base);
    expect_agrees(detail::integer_orient3d<3>(p, q, r, s), truth, "integer192", c.base);
    expect_agrees(detail::integer_orient3d<4>(p, q, r, s), truth, "integer256", c.base);
    expect_agrees(detail::big_orient3d(p, q, r, s), truth, "big", c.base);
    expect_agrees(orient3d(p, q, r, s), truth, "orient3d", c.base);
    EXPECT_EQ(orient3d(q, p, r, s), -truth);
    EXPECT_EQ(orient3d(p, q, s, r), -truth);
    EXPECT_EQ(orient3d(q, r, p, s), truth);
    ++decided[detail::decide_orient3d(p, q, r, s).tier];
  }
  for (const Tier tier :
       {Tier::integer64, Tier::integer128, Tier::integer192, Tier::integer256, Tier::big_integer}) {
    EXPECT_GT(decided[tier], 100) << "tier " << static_cast<int>(tier) << " is hardly tested";
  }
}

TEST(PredicateLaw, MixedOrient2dAgreesWithRationals) {
  Random random(26);
  MixedCase c;
  for (int i = 0; i < 5000; ++i) {
    make_mixed(random, c);
    const auto [p, q, r, s] = c.p;
    const int axis = integer(random, 0, 2);
    const int truth = reference_orient2d(p, q, r, axis);
    expect_agrees(detail::integer_orient2d<1>(p, q, r, axis), truth, "integer64", c.base);
    expect_agrees(detail::integer_orient2d<2>(p, q, r, axis), truth, "integer128", c.base);
    expect_agrees(detail::integer_orient2d<3>(p, q, r, axis), truth, "integer192", c.base);
    expect_agrees(detail::integer_orient2d<4>(p, q, r, axis), truth, "integer256", c.base);
    expect_agrees(detail::big_orient2d(p, q, r, axis), truth, "big", c.base);
    expect_agrees(orient2d(p, q, r, axis), truth, "orient2d", c.base);
    EXPECT_EQ(orient2d(q, p, r, axis), -truth);
    EXPECT_EQ(orient2d(q, r, p, axis), truth);
  }
}

TEST(PredicateLaw, PointsOfASegmentAreCollinear) {
  Random random(27);
  for (int i = 0; i < 2000; ++i) {
    Point3 a, b, apex;
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] = uniform(random, -1, 1);
      b[k] = uniform(random, -1, 1);
      apex[k] = uniform(random, -1, 1);
    }
    const MadePoint p = between(a, b, random_fraction(random, integer(random, 1, 300)));
    EXPECT_EQ(orient3d(PointRef{a.data()}, PointRef{b.data()}, p.ref(), PointRef{apex.data()}), 0);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(orient2d(PointRef{a.data()}, PointRef{b.data()}, p.ref(), axis), 0);
    }
  }
}

TEST(PredicateLaw, SwapsNegate) {
  Random random(28);
  for (int i = 0; i < 20000; ++i) {
    const Case c = random_case(random);
    std::array<const double*, 5> p;
    for (std::size_t k = 0; k < 5; ++k) p[k] = c.p[k].data();
    const int sphere = insphere(p[0], p[1], p[2], p[3], p[4]);
    const int orientation = orient3d(p[0], p[1], p[2], p[3]);
    const auto k = static_cast<std::size_t>(integer(random, 0, 3));
    auto q = p;
    std::swap(q[k], q[k + 1]);
    EXPECT_EQ(insphere(q[0], q[1], q[2], q[3], q[4]), -sphere) << describe(c);
    if (k < 3) {
      EXPECT_EQ(orient3d(q[0], q[1], q[2], q[3]), -orientation) << describe(c);
    }
    q = p;
    q[k] = p[4];
    EXPECT_EQ(insphere(q[0], q[1], q[2], q[3], q[4]), 0) << describe(c);
  }
}

TEST(PredicateLaw, ExactTranslationAndScalingChangeNothing) {
  Random random(29);
  for (int i = 0; i < 5000; ++i) {
    // Integers of 20 bits, moved by integers of 40 bits and scaled by a power of two.
    std::array<Point3, 5> p, moved;
    Point3 shift;
    for (double& x : shift) x = static_cast<double>(static_cast<std::int64_t>(random() >> 24));
    const int exponent = integer(random, -1000, 900);
    for (std::size_t k = 0; k < 5; ++k) {
      for (std::size_t j = 0; j < 3; ++j) {
        p[k][j] = integer(random, 0, 3) == 0 ? integer(random, 0, 3) : integer(random, 0, 1 << 20);
        moved[k][j] = std::ldexp(p[k][j] + shift[j], exponent);
      }
    }
    EXPECT_EQ(orient3d(p[0].data(), p[1].data(), p[2].data(), p[3].data()),
              orient3d(moved[0].data(), moved[1].data(), moved[2].data(), moved[3].data()));
    EXPECT_EQ(insphere(p[0].data(), p[1].data(), p[2].data(), p[3].data(), p[4].data()),
              insphere(moved[0].data(), moved[1].data(), moved[2].data(), moved[3].data(), moved[4].data()));
    EXPECT_EQ(orient2d(p[0].data(), p[1].data(), p[2].data()),
              orient2d(moved[0].data(), moved[1].data(), moved[2].data()));
  }
}

TEST(PointLaw, DifferenceIsAccurate) {
  Random random(30);
  MixedCase c;
  for (int i = 0; i < 5000; ++i) {
    make_mixed(random, c);
    const PointRef p = c.p[0], q = c.p[static_cast<std::size_t>(integer(random, 0, 3))];
    double out[3];
    difference(p, q, out);
    const RationalPoint exact = minus(rational(p), rational(q));
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational error = abs(rational(out[k]) - exact[k]);
      EXPECT_LE(error, scaled(Rational(abs(exact[k])), -52) + scaled(Rational(1), -1075)) << describe(c.base);
    }
  }
}

}  // namespace
}  // namespace holdfast::exact::test::exact_predicates_law_test
