// Fixed-width integers against unbounded ones.
#include <gtest/gtest.h>

#include "exact/fixed_int.h"
#include "exact_reference.h"

namespace holdfast::exact::test::exact_fixed_int_test {
namespace {

template <std::size_t N>
Integer value(const FixedInt<N>& x) {
  Integer result = 0;
  for (std::size_t i = N; i-- > 0;) result = (result << 64) + x.limb[i];
  if (x.negative()) result -= Integer(1) << (64 * N);
  return result;
}

/// Limbs of extremes and of noise; the upper two bits leave room for a sum.
template <std::size_t N>
FixedInt<N> random_integer(Random& random) {
  FixedInt<N> result;
  for (auto& limb : result.limb) {
    const int kind = integer(random, 0, 3);
    limb = kind == 0 ? 0 : kind == 1 ? ~std::uint64_t{0} : random();
  }
  auto& top = result.limb[N - 1];
  top = static_cast<std::uint64_t>(static_cast<std::int64_t>(top) >> integer(random, 2, 63));
  return result;
}

template <std::size_t A, std::size_t B>
void check_operations(std::uint64_t seed) {
  Random random(seed);
  for (int i = 0; i < 3000; ++i) {
    const auto a = random_integer<A>(random);
    const auto b = random_integer<A>(random);
    const auto c = random_integer<B>(random);
    EXPECT_EQ(value(a + b), Integer(value(a) + value(b)));
    EXPECT_EQ(value(a - b), Integer(value(a) - value(b)));
    EXPECT_EQ(value(-a), Integer(-value(a)));
    EXPECT_EQ(value(a * c), Integer(value(a) * value(c)));
    EXPECT_EQ(value(c * a), Integer(value(a) * value(c)));
    EXPECT_EQ(a.sign(), value(a).sign());
    EXPECT_EQ((a - a).sign(), 0);
  }
}

TEST(FixedInt, OperationsEqualUnboundedOnes) {
  check_operations<1, 1>(1);
  check_operations<2, 1>(2);
  check_operations<2, 2>(3);
  check_operations<4, 2>(4);
  check_operations<6, 3>(5);
  check_operations<8, 4>(6);
}

TEST(FixedInt, CarriesAreTheSameOnEveryMachine) {
  Random random(7);
  for (int i = 0; i < 3000; ++i) {
    const auto a = random_integer<1>(random).limb[0], b = random_integer<1>(random).limb[0];
    for (unsigned char carry = 0; carry < 2; ++carry) {
      const LimbAndCarry sum = add_limbs(a, b, carry), portable = detail::portable_add(a, b, carry);
      EXPECT_EQ(sum.limb, portable.limb);
      EXPECT_EQ(sum.carry, portable.carry);
      const LimbAndCarry difference = subtract_limbs(a, b, carry);
      const LimbAndCarry portable_difference = detail::portable_subtract(a, b, carry);
      EXPECT_EQ(difference.limb, portable_difference.limb);
      EXPECT_EQ(difference.carry, portable_difference.carry);
      EXPECT_EQ(Integer(a) + b + carry, (Integer(sum.carry) << 64) + sum.limb);
    }
  }
}

}  // namespace
}  // namespace holdfast::exact::test::exact_fixed_int_test
