// Binary fractions against rationals on random values of all sizes.
#include <gtest/gtest.h>

#include "exact_reference.h"

namespace holdfast::exact::test::exact_dyadic_law_test {
namespace {

/// A random value: few or many bits, any exponent, often next to a tie between two doubles.
Dyadic random_value(Random& random) {
  static constexpr int kExponents[] = {0, -1100, -1075, -1024, 960, 1000, -500};
  Dyadic x = random_fraction(random, integer(random, 1, 300)).scaled(kExponents[integer(random, 0, 6)]);
  if (integer(random, 0, 2) == 0) {
    // Half an ulp beside a double, or a hair beside that.
    const double near = x.to_double();
    const double ulp = std::nextafter(near, HUGE_VAL) - near;
    if (std::isfinite(ulp)) x = Dyadic(near) + Dyadic(ulp).scaled(-1);
    if (integer(random, 0, 1) == 0) x += Dyadic(integer(random, -1, 1)).scaled(-1300);
  }
  return integer(random, 0, 1) == 0 ? x : -x;
}

/// Whether d is the double nearest to q, ties to even.
bool nearest(const Rational& q, double d) {
  if (std::isinf(d)) return abs(q) >= rational(0x1.fffffffffffffp1023) + scaled(Rational(1), 970);
  const Rational error = abs(q - rational(d));
  for (const double towards : {HUGE_VAL, -HUGE_VAL}) {
    const double other = std::nextafter(d, towards);
    const Rational value = std::isinf(other) ? scaled(Rational(other > 0 ? 1 : -1), 1024) : rational(other);
    const Rational distance = abs(q - value);
    if (distance < error) return false;
    if (distance == error && (std::bit_cast<std::uint64_t>(d) & 1) != 0) return false;
  }
  return true;
}

TEST(DyadicLaw, RoundsToNearest) {
  Random random(11);
  for (int i = 0; i < 4000; ++i) {
    const Dyadic x = random_value(random);
    EXPECT_TRUE(nearest(rational(x), x.to_double())) << x.to_string() << " gave " << x.to_double();
  }
}

TEST(DyadicLaw, IsDoubleWhereRoundingChangesNothing) {
  Random random(12);
  for (int i = 0; i < 4000; ++i) {
    const Dyadic x = random_value(random);
    const double d = x.to_double();
    EXPECT_EQ(x.is_double(), std::isfinite(d) && Dyadic(d) == x) << x.to_string();
  }
}

TEST(DyadicLaw, TwoDoublesCarry105Bits) {
  Random random(13);
  for (int i = 0; i < 4000; ++i) {
    const Dyadic x = random_value(random);
    if (std::fabs(x.to_double()) >= 0x1p1023) continue;
    const TwoTerms terms = x.to_two_doubles();
    const Rational value = rational(x);
    const Rational error = abs(value - rational(terms.high) - rational(terms.low));
    EXPECT_LE(error, scaled(abs(value), -105) + scaled(Rational(1), -1075)) << x.to_string();
    EXPECT_EQ(terms.high + terms.low, terms.high);
  }
}

TEST(DyadicLaw, ArithmeticEqualsRational) {
  Random random(14);
  for (int i = 0; i < 3000; ++i) {
    const Dyadic x = random_value(random);
    const Dyadic y = integer(random, 0, 4) == 0 ? x : random_value(random);
    const Rational p = rational(x), q = rational(y);
    EXPECT_EQ(rational(x + y), Rational(p + q));
    EXPECT_EQ(rational(x - y), Rational(p - q));
    EXPECT_EQ(rational(x * y), Rational(p * q));
    EXPECT_EQ(rational(-x), Rational(-p));
    EXPECT_EQ(x < y, p < q);
    EXPECT_EQ(x == y, p == q);
    EXPECT_EQ(x.sign(), p.sign());
    for (const Dyadic& z : {x + y, x - y, x * y}) {
      EXPECT_TRUE(z.sign() == 0 ? z.exponent() == 0 : (z.limbs()[0] & 1) == 1) << z.to_string();
    }
  }
}

}  // namespace
}  // namespace holdfast::exact::test::exact_dyadic_law_test
