// Points of the plane with rational coordinates.
#include "exact/rational_point.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "exact/determinant.h"
#include "exact/expansion.h"
#include "exact/fixed_int.h"
#include "exact/float_bits.h"
#include "numbers/float_environment.h"

namespace holdfast::exact {
namespace {

/// p - q as homogeneous integers, whose weight is positive.
RationalPoint difference(const RationalPoint& p, const RationalPoint& q) {
  return {p.x * q.w - q.x * p.w, p.y * q.w - q.y * p.w, p.w * q.w};
}

Row<BigInt> row(const RationalPoint& p) { return {p.x, p.y, p.w}; }

/// |m| = (bits + rest) 2^exponent with 0 <= rest < 1; `bits` has 128 bits, the highest one set.
struct LeadingBits {
  Uint128 bits;
  std::int64_t exponent;
};

LeadingBits leading_bits(const BigInt& m) {
  const Limb* limbs = m.backend().limbs();
  const std::size_t size = m.backend().size();
  const auto limb = [&](std::size_t from_above) {
    return from_above < size ? limbs[size - 1 - from_above] : Limb{0};
  };
  const int zeros = std::countl_zero(limb(0));
  Uint128 bits = static_cast<Uint128>(limb(0)) << 64 | limb(1);
  if (zeros > 0) bits = bits << zeros | limb(2) >> (64 - zeros);
  return {bits, 64 * (static_cast<std::int64_t>(size) - 2) - zeros};
}

/// The double nearest to |n / d|, if the leading bits determine it and it is no denormal; else none.
///
/// Let m be half the bits of n, rounded down, and e the upper 64 bits of d. The quotient
/// is v 2^k with m / (e + 1) < v < (m + 1) / e. Now q = floor(m / e) is in (2^62 - 1, 2^64), so v > m / e - 2
/// and v < q + 2. Rounding is monotonic: if q - 2 and q + 2 round to the same double, v rounds to it, too.
std::optional<double> nearest_by_leading_bits(const BigInt& n, const BigInt& d) {
  const LeadingBits a = leading_bits(n), b = leading_bits(d);
  const Uint128 quotient = (a.bits >> 1) / static_cast<std::uint64_t>(b.bits >> 64);
  const auto q = static_cast<std::uint64_t>(quotient);
  const double low = static_cast<double>(q - 2);
  if (q > std::numeric_limits<std::uint64_t>::max() - 2 || low != static_cast<double>(q + 2)) return {};
  const std::int64_t exponent = a.exponent + 1 - (b.exponent + 64);
  if (exponent < -1000 || exponent > 950) return {};
  return low * power_of_two(static_cast<int>(exponent));
}

std::int64_t bits(const BigInt& m) {
  return m.is_zero() ? 0 : static_cast<std::int64_t>(boost::multiprecision::msb(abs(m))) + 1;
}

}  // namespace

/// Where the leading bits are not enough, the quotient has at least 66 bits. A last bit that stands for the
/// rest makes it round like the exact value.
double nearest_quotient(const BigInt& n, const BigInt& d) {
  if (n.is_zero()) return 0;
  if (const auto nearest = nearest_by_leading_bits(n, d)) return n.sign() < 0 ? -*nearest : *nearest;
  const std::int64_t shift = std::max<std::int64_t>(0, 66 - (bits(n) - bits(d)));
  BigInt quotient, rest;
  divide_qr(BigInt(abs(n) << static_cast<std::size_t>(shift)), d, quotient, rest);
  quotient <<= 1;
  if (!rest.is_zero()) quotient += 1;
  return Dyadic(n.sign() < 0 ? BigInt(-quotient) : quotient, -shift - 1).to_double();
}

/// Two doubles for each number hold 106 of its leading bits. Let q be the rounded quotient of the first
/// doubles and r = n - q d, which is 2^-52 of n and errs by 2^-104 of n. Then q + r / d errs by at most
/// 2^-103.
double rest_of_quotient(const BigInt& n, const BigInt& d, double high) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  if (n.is_zero()) return 0;
  const LeadingBits a = leading_bits(n), b = leading_bits(d);
  const std::int64_t exponent = a.exponent - b.exponent;
  if (exponent < -800 || exponent > 800) return kUnknown;
  const auto two_doubles = [](Uint128 bits) {  // in [1, 2]
    const auto upper = static_cast<double>(static_cast<std::uint64_t>(bits >> 75)) * 0x1p-52;
    return TwoTerms{
        upper, static_cast<double>(static_cast<std::uint64_t>(bits >> 22) & (kHiddenBit * 2 - 1)) * 0x1p-105};
  };
  const TwoTerms x = two_doubles(a.bits), y = two_doubles(b.bits);
  const double q = x.high / y.high;
  const TwoTerms product = two_product(q, y.high);
  const double r = ((x.high - product.high) - product.low) + (x.low - q * y.low);
  const TwoTerms sum = fast_two_sum(q, r / y.high);
  const double scaled = std::fabs(high) * power_of_two(static_cast<int>(-exponent));
  const double rest = ((sum.high - scaled) + sum.low) * power_of_two(static_cast<int>(exponent));
  return n.sign() < 0 ? -rest : rest;
}

RationalPoint rational_point(const double* p) {
  const Dyadic x(p[0]), y(p[1]);
  const std::int64_t low = std::min({x.exponent(), y.exponent(), std::int64_t{0}});
  const auto scaled = [&](const Dyadic& value) {
    return BigInt(value.mantissa() << static_cast<std::size_t>(value.exponent() - low));
  };
  return {scaled(x), scaled(y), BigInt(1) << static_cast<std::size_t>(-low)};
}

RationalPoint crossing(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c,
                       const RationalPoint& d) {
  const Row<BigInt> p = cross(cross(row(a), row(b)), cross(row(c), row(d)));
  RationalPoint point{p[0], p[1], p[2]};
  if (point.w < 0) point = {-point.x, -point.y, -point.w};
  // In lowest terms, so that points on lines through this point do not grow more than necessary.
  const BigInt common = gcd(gcd(abs(point.x), abs(point.y)), point.w);
  if (common > 1) point = {point.x / common, point.y / common, point.w / common};
  return point;
}

std::array<double, 2> nearest(const RationalPoint& p) {
  return {nearest_quotient(p.x, p.w), nearest_quotient(p.y, p.w)};
}

int orient2d(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  return sign_det3(row(a), row(b), row(c));
}

int incircle(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c, const RationalPoint& d) {
  const auto lifted = [&](const RationalPoint& p) {
    const RationalPoint u = difference(p, d);
    return Row<BigInt>{u.x * u.w, u.y * u.w, u.x * u.x + u.y * u.y};
  };
  return sign_det3(lifted(a), lifted(b), lifted(c));
}

int compare(const RationalPoint& a, const RationalPoint& b) {
  const RationalPoint u = difference(a, b);
  return u.x.sign() != 0 ? u.x.sign() : u.y.sign();
}

int compare_heights(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c,
                    const RationalPoint& d) {
  const RationalPoint u = difference(b, a), v = difference(d, c);
  return BigInt(u.x * v.y - u.y * v.x).sign();
}

}  // namespace holdfast::exact
