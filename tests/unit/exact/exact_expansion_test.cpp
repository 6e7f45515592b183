// Expansion arithmetic on its own, against rationals.
#include <gtest/gtest.h>

#include "exact/expansion.h"
#include "exact_reference.h"

namespace holdfast::exact::test::exact_expansion_test {
namespace {

double random_double(Random& random) {
  return integer(random, 0, 9) == 0 ? integer(random, -2, 2)
                                    : std::ldexp(uniform(random, -1, 1), integer(random, -80, 80));
}

Rational value(TwoTerms terms) { return rational(terms.high) + rational(terms.low); }

template <std::size_t N>
Rational value(const Expansion<N>& e) {
  Rational sum = 0;
  for (std::size_t i = 0; i < e.size(); ++i) sum += rational(e[i]);
  return sum;
}

/// Components grow, do not overlap, and none is zero.
template <std::size_t N>
bool well_formed(const Expansion<N>& e) {
  for (std::size_t i = 0; i < e.size(); ++i) {
    if (e[i] == 0) return false;
    // The sum of two nonoverlapping doubles rounds to the larger one, up to a tie.
    if (i > 0 && std::fabs(e[i - 1]) >= std::fabs(e[i])) return false;
    int exponent = 0;
    std::frexp(i > 0 ? e[i - 1] : 0, &exponent);
    if (i > 0 && std::remainder(e[i], std::ldexp(1.0, exponent)) != 0) return false;
  }
  return true;
}

Expansion<4> random_expansion(Random& random) {
  const Expansion<2> x(two_product(random_double(random), random_double(random)));
  const Expansion<2> y(two_product(random_double(random), random_double(random)));
  return x + y;
}

TEST(Expansion, SplitGivesShortHalves) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const double x = random_double(random);
    const TwoTerms halves = split(x);
    EXPECT_EQ(halves.high + halves.low, x);
    // 26 bits each: squares are exact.
    EXPECT_EQ(rational(halves.high * halves.high), Rational(rational(halves.high) * rational(halves.high)));
    EXPECT_EQ(rational(halves.low * halves.low), Rational(rational(halves.low) * rational(halves.low)));
  }
}

TEST(Expansion, TwoTermOperationsAreExact) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const double a = random_double(random), b = random_double(random);
    const Rational p = rational(a), q = rational(b);
    EXPECT_EQ(value(two_sum(a, b)), Rational(p + q));
    EXPECT_EQ(value(two_diff(a, b)), Rational(p - q));
    EXPECT_EQ(value(two_product(a, b)), Rational(p * q));
    const bool a_first = std::fabs(a) >= std::fabs(b);
    EXPECT_EQ(value(a_first ? fast_two_sum(a, b) : fast_two_sum(b, a)), Rational(p + q));
    EXPECT_EQ(two_sum(a, b).high, a + b);
    EXPECT_EQ(two_product(a, b).high, a * b);
  }
}

TEST(Expansion, ZeroHasNoComponent) {
  EXPECT_EQ(Expansion<1>(0.0).size(), 0U);
  EXPECT_EQ(Expansion<1>(0.0).sign(), 0);
  EXPECT_EQ((Expansion<1>(3.0) - Expansion<1>(3.0)).size(), 0U);
  EXPECT_EQ((Expansion<1>(0.0) * Expansion<1>(3.0)).sign(), 0);
  EXPECT_EQ((Expansion<1>(3.0) * Expansion<1>(0.0)).sign(), 0);
  EXPECT_EQ((Expansion<1>(0.0) + Expansion<1>(0.0)).sign(), 0);
}

TEST(Expansion, RingOperationsAreExactAndWellFormed) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Expansion<4> e = random_expansion(random);
    const Expansion<4> f = integer(random, 0, 7) == 0 ? -e : random_expansion(random);
    const double b = random_double(random);
    const Rational p = value(e), q = value(f);
    const auto sum = e + f;
    const auto difference = e - f;
    const auto multiple = scale(e, b);
    const auto product = e * f;
    EXPECT_EQ(value(sum), Rational(p + q));
    EXPECT_EQ(value(difference), Rational(p - q));
    EXPECT_EQ(value(multiple), Rational(p * rational(b)));
    EXPECT_EQ(value(product), Rational(p * q));
    EXPECT_TRUE(well_formed(sum));
    EXPECT_TRUE(well_formed(difference));
    EXPECT_TRUE(well_formed(multiple));
    EXPECT_TRUE(well_formed(product));
    EXPECT_EQ(sum.sign(), Rational(p + q).sign());
    EXPECT_EQ(product.sign(), Rational(p * q).sign());
    EXPECT_LE(abs(rational(product.estimate()) - p * q), scaled(Rational(abs(p * q)), -48));
  }
}

}  // namespace
}  // namespace holdfast::exact::test::exact_expansion_test
