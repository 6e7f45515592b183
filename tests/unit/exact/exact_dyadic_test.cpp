// Binary fractions: representation, conversion, arithmetic on chosen values.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "exact/dyadic.h"
#include "exact/rational_point.h"

namespace holdfast::exact::exact_dyadic_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMax = std::numeric_limits<double>::max();

/// 2^k.
Dyadic power(std::int64_t k) { return Dyadic(1).scaled(k); }

TEST(Dyadic, ZeroIsOneValue) {
  EXPECT_EQ(Dyadic(), Dyadic(0.0));
  EXPECT_EQ(Dyadic(-0.0), Dyadic(0.0));
  EXPECT_EQ(Dyadic(3) - Dyadic(3), Dyadic());
  EXPECT_EQ(-Dyadic(), Dyadic());
  EXPECT_EQ(Dyadic().scaled(7), Dyadic());
  EXPECT_EQ(Dyadic().sign(), 0);
  EXPECT_EQ(Dyadic().bits(), 0U);
  EXPECT_EQ(Dyadic().to_double(), 0.0);
  EXPECT_FALSE(std::signbit((-Dyadic()).to_double()));
  EXPECT_TRUE(Dyadic().is_double());
}

TEST(Dyadic, MantissaIsOdd) {
  const Dyadic x(48.0);
  EXPECT_EQ(x.mantissa(), 3);
  EXPECT_EQ(x.exponent(), 4);
  EXPECT_EQ(x.bits(), 2U);
  EXPECT_EQ(Dyadic(BigInt(-96), -5), Dyadic(-3));
  EXPECT_EQ(Dyadic(BigInt(0), 99), Dyadic());
  EXPECT_EQ(Dyadic(BigInt(1) << 700, -700), Dyadic(1));
}

TEST(Dyadic, Spells) {
  EXPECT_EQ(Dyadic(0.75).to_string(), "3*2^-2");
  EXPECT_EQ(Dyadic(-10).to_string(), "-5*2^1");
  EXPECT_EQ(Dyadic().to_string(), "0*2^0");
  // 10^36 + 1 has groups of zeros.
  const BigInt million_cubed = BigInt(1'000'000'000'000'000'000ULL);
  EXPECT_EQ(Dyadic(million_cubed * million_cubed + 1, 0).to_string(),
            "1000000000000000000000000000000000001*2^0");
}

TEST(Dyadic, EveryDoubleSurvives) {
  for (const double x : {1.0, -1.0, 0.1, kMax, -kMax, 0x1p-1022, 0x1p-1074, -0x1p-1074,
                         0x1.fffffffffffffp-1023, 0x1.8p-1070, 3.0}) {
    EXPECT_EQ(Dyadic(x).to_double(), x);
    EXPECT_TRUE(Dyadic(x).is_double());
  }
}

TEST(Dyadic, TiesGoToEven) {
  const Dyadic half_ulp = power(-53);
  EXPECT_EQ((Dyadic(1) + half_ulp).to_double(), 1.0);
  EXPECT_EQ((Dyadic(1) + half_ulp + power(-2000)).to_double(), 1 + 0x1p-52);
  EXPECT_EQ((Dyadic(1) + half_ulp - power(-2000)).to_double(), 1.0);
  EXPECT_EQ((Dyadic(1 + 0x1p-52) + half_ulp).to_double(), 1 + 0x1p-51);
  EXPECT_EQ((-Dyadic(1 + 0x1p-52) - half_ulp).to_double(), -1 - 0x1p-51);
  EXPECT_EQ((Dyadic(2) - power(-54)).to_double(), 2.0);  // carries into the next binade
}

TEST(Dyadic, DenormalsRoundToNearest) {
  const double least = 0x1p-1074;
  EXPECT_EQ(power(-1075).to_double(), 0.0);  // a tie: zero is even
  EXPECT_EQ((power(-1075) + power(-1200)).to_double(), least);
  EXPECT_EQ((power(-1075) - power(-1200)).to_double(), 0.0);
  EXPECT_EQ(Dyadic(3).scaled(-1075).to_double(), 2 * least);  // 1.5 of the least: 2 is even
  EXPECT_EQ(Dyadic(5).scaled(-1075).to_double(), 2 * least);
  EXPECT_EQ(power(-1076).to_double(), 0.0);
  EXPECT_EQ(Dyadic(3).scaled(-1077).to_double(), 0.0);
  EXPECT_EQ(power(-5000).to_double(), 0.0);
  EXPECT_EQ((-power(-1074)).to_double(), -least);
  // Just below the least normal number: rounds up to it.
  EXPECT_EQ((power(-1022) - power(-1076)).to_double(), 0x1p-1022);
  EXPECT_EQ((power(-1022) - power(-1074)).to_double(), 0x1p-1022 - least);
}

TEST(Dyadic, OverflowsToInfinity) {
  const Dyadic max(kMax);
  const Dyadic half_ulp = power(970);
  EXPECT_EQ((max + half_ulp).to_double(), kInfinity);  // a tie: the next power of two is even
  EXPECT_EQ((max + half_ulp - power(0)).to_double(), kMax);
  EXPECT_EQ((-max - half_ulp).to_double(), -kInfinity);
  EXPECT_EQ(power(1024).to_double(), kInfinity);
  EXPECT_EQ(power(1'000'000).to_double(), kInfinity);
  EXPECT_EQ((-power(1024)).to_double(), -kInfinity);
}

TEST(Dyadic, KnowsWhatIsADouble) {
  EXPECT_TRUE(power(1023).is_double());
  EXPECT_FALSE(power(1024).is_double());
  EXPECT_TRUE(power(-1074).is_double());
  EXPECT_FALSE(power(-1075).is_double());
  EXPECT_FALSE(Dyadic(3).scaled(-1075).is_double());
  EXPECT_TRUE((power(53) - Dyadic(1)).is_double());
  EXPECT_FALSE((power(53) + Dyadic(1)).is_double());
}

TEST(Dyadic, Orders) {
  EXPECT_LT(Dyadic(-1), Dyadic());
  EXPECT_LT(Dyadic(), power(-3000));
  EXPECT_LT(Dyadic(1), Dyadic(1) + power(-3000));
  EXPECT_GT(Dyadic(-1), Dyadic(-1) - power(-3000));
  EXPECT_LT(Dyadic(3), Dyadic(4));
  EXPECT_LT(Dyadic(-4), Dyadic(-3));
  EXPECT_GE(Dyadic(0.5), power(-1));
}

TEST(Dyadic, ComputesExactly) {
  EXPECT_NE(Dyadic(0.1) + Dyadic(0.2), Dyadic(0.3));
  EXPECT_EQ(Dyadic(0.1) + Dyadic(0.2) - Dyadic(0.2), Dyadic(0.1));
  EXPECT_EQ(Dyadic(1e300) * Dyadic(1e300) * Dyadic(0), Dyadic());
  Dyadic x(1.5);
  x += x;
  EXPECT_EQ(x, Dyadic(3));
  x *= x;
  EXPECT_EQ(x, Dyadic(9));
  const Dyadic same = x;
  x -= same;
  EXPECT_EQ(x, Dyadic());
}

/// Up to 500 bits, and equally often few bits.
BigInt random_integer(std::mt19937_64& random) {
  const unsigned bits = 1 + static_cast<unsigned>(random() % (random() % 2 == 0 ? 500 : 80));
  BigInt m = 0;
  for (unsigned k = 0; k < bits; k += 64) m = (m << 64) + BigInt(random());
  m >>= (bits + 63) / 64 * 64 - bits;
  return m + 1;
}

/// Integers decide which of two consecutive doubles is nearer to a quotient.
TEST(Quotient, IsRoundedToTheNearestDouble) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 20000; ++k) {
    BigInt n = random_integer(random);
    const BigInt d = random_integer(random);
    if (k % 4 == 0) n = d * BigInt(random() >> 8) + (k % 8 == 0 ? 1 : 0);  // at a tie, or next to it
    const double nearest = nearest_quotient(n, d);
    ASSERT_GT(nearest, 0);
    EXPECT_EQ(nearest_quotient(BigInt(-n), d), -nearest);
    const Dyadic exact_n(n, 0), exact_d(d, 0);
    const auto apart = [&](double x) {
      const Dyadic difference = exact_n - Dyadic(x) * exact_d;
      return difference.sign() < 0 ? -difference : difference;
    };
    const Dyadic mine = apart(nearest);
    for (const double other : {std::nextafter(nearest, 0.0), std::nextafter(nearest, kInfinity)})
      EXPECT_LE(mine, apart(other)) << n.str() << " / " << d.str();
    const double rest = rest_of_quotient(n, d, nearest);
    const Dyadic error = exact_n - (Dyadic(nearest) + Dyadic(rest)) * exact_d;
    EXPECT_LE(error.sign() < 0 ? -error : error, Dyadic(nearest) * exact_d * power(-100));
  }
}

}  // namespace
}  // namespace holdfast::exact::exact_dyadic_test
