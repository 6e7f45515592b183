// Exact binary fractions m * 2^e.
#include "exact/dyadic.h"

#include <cmath>
#include <limits>
#include <utility>

#include "exact/float_bits.h"

namespace holdfast::exact {
namespace {

/// The leading 128 bits of a non-zero mantissa, with the highest bit set.
struct LeadingLimbs {
  Limb first;
  Limb second;
};

LeadingLimbs leading_limbs(const Dyadic& x) {
  const Limb* limbs = x.limbs();
  const std::size_t size = x.bits();
  const std::size_t last = (size - 1) / 64;
  const auto limb = [&](std::size_t below) { return below <= last ? limbs[last - below] : Limb{0}; };
  const std::size_t shift = 63 - (size - 1) % 64;
  if (shift == 0) return {limb(0), limb(1)};
  return {limb(0) << shift | limb(1) >> (64 - shift), limb(1) << shift | limb(2) >> (64 - shift)};
}

/// Decimal digits by groups of 18 (BigInt::str trips -Wrestrict of g++ 12).
std::string decimal(BigInt m) {
  constexpr std::uint64_t kGroup = 1'000'000'000'000'000'000;
  const bool negative = m.sign() < 0;
  if (negative) m.backend().negate();
  std::string digits;
  while (m >= kGroup) {
    const std::string group = std::to_string(static_cast<std::uint64_t>(m % kGroup));
    digits.insert(0, std::string(18 - group.size(), '0') + group);
    m /= kGroup;
  }
  digits.insert(0, std::to_string(static_cast<std::uint64_t>(m)));
  return negative ? "-" + digits : digits;
}

}  // namespace

std::size_t trailing_zeros(const BigInt& m) {
  const Limb* limbs = m.backend().limbs();
  std::size_t i = 0;
  while (limbs[i] == 0) ++i;
  return i * 64 + static_cast<std::size_t>(std::countr_zero(limbs[i]));
}

Dyadic::Dyadic(double value) {
  FloatParts parts = float_parts(magnitude_bits(value));
  if (parts.mantissa == 0) return;
  const int zeros = std::countr_zero(parts.mantissa);
  mantissa_ = parts.mantissa >> zeros;
  if (value < 0) mantissa_.backend().negate();
  exponent_ = parts.exponent + zeros;
}

Dyadic::Dyadic(BigInt mantissa, std::int64_t exponent) : mantissa_(std::move(mantissa)), exponent_(exponent) {
  normalise();
}

void Dyadic::normalise() {
  if (mantissa_.is_zero()) {
    exponent_ = 0;
    return;
  }
  const std::size_t zeros = trailing_zeros(mantissa_);
  if (zeros == 0) return;
  // Rounding towards zero and to minus infinity agree, since only zeros are shifted out.
  mantissa_ >>= zeros;
  exponent_ += static_cast<std::int64_t>(zeros);
}

double Dyadic::to_double() const {
  if (mantissa_.is_zero()) return 0;
  const double sign = mantissa_.sign() < 0 ? -1.0 : 1.0;
  const auto size = static_cast<std::int64_t>(bits());
  const std::int64_t top = exponent_ + size - 1;  // 2^top <= |value| < 2^(top + 1)
  if (top > 1023) return sign * std::numeric_limits<double>::infinity();
  const std::int64_t precision = top >= -1022 ? 53 : top + 1075;
  if (precision < 0) return sign * 0.0;
  std::uint64_t leading = leading_limbs(*this).first;
  const bool half = precision < size && (leading << precision) >> 63 != 0;
  leading = precision == 0 ? 0 : leading >> (64 - precision);
  // The mantissa is odd: if two or more bits are dropped, the lowest of them is set, so there is no tie.
  if (half && (size - precision >= 2 || (leading & 1) != 0)) ++leading;
  const std::int64_t exponent = top + 1 - precision;
  if (exponent >= -1022 && exponent <= 970) {
    return sign * static_cast<double>(leading) * power_of_two(static_cast<int>(exponent));
  }
  return sign * std::ldexp(static_cast<double>(leading), static_cast<int>(exponent));
}

TwoTerms Dyadic::to_two_doubles() const {
  if (mantissa_.is_zero()) return {0, 0};
  const std::int64_t top = exponent_ + static_cast<std::int64_t>(bits());
  if (top < -900 || top > 1023) {
    const double high = to_double();
    return {high, (*this - Dyadic(high)).to_double()};
  }
  const LeadingLimbs leading = leading_limbs(*this);
  const double scale = mantissa_.sign() < 0 ? -power_of_two(static_cast<int>(top - 53))
                                            : power_of_two(static_cast<int>(top - 53));
  // 53 bits each, the rest cut off.
  const std::uint64_t second = (leading.first << 53 | leading.second >> 11) >> 11;
  return fast_two_sum(static_cast<double>(leading.first >> 11) * scale,
                      static_cast<double>(second) * (0x1p-53 * scale));
}

bool Dyadic::is_double() const {
  if (mantissa_.is_zero()) return true;
  const auto size = static_cast<std::int64_t>(bits());
  return size <= 53 && exponent_ >= -1074 && exponent_ + size <= 1024;
}

std::string Dyadic::to_string() const { return decimal(mantissa_) + "*2^" + std::to_string(exponent_); }

Dyadic Dyadic::scaled(std::int64_t k) const {
  Dyadic result = *this;
  if (!result.mantissa_.is_zero()) result.exponent_ += k;
  return result;
}

Dyadic Dyadic::operator-() const {
  Dyadic result = *this;
  if (!result.mantissa_.is_zero()) result.mantissa_.backend().negate();
  return result;
}

Dyadic Dyadic::sum(const Dyadic& a, const Dyadic& b, bool negate_b) {
  if (b.mantissa_.is_zero()) return a;
  if (a.mantissa_.is_zero()) return negate_b ? -b : b;
  Dyadic result;
  if (a.exponent_ >= b.exponent_) {
    result.mantissa_ = a.mantissa_ << static_cast<std::size_t>(a.exponent_ - b.exponent_);
    if (negate_b) {
      result.mantissa_ -= b.mantissa_;
    } else {
      result.mantissa_ += b.mantissa_;
    }
    result.exponent_ = b.exponent_;
  } else {
    result.mantissa_ = b.mantissa_ << static_cast<std::size_t>(b.exponent_ - a.exponent_);
    if (negate_b) result.mantissa_.backend().negate();
    result.mantissa_ += a.mantissa_;
    result.exponent_ = a.exponent_;
  }
  // If the exponents differ, the sum of the aligned mantissas is odd.
  if (a.exponent_ == b.exponent_) result.normalise();
  return result;
}

Dyadic& Dyadic::operator+=(const Dyadic& other) { return *this = sum(*this, other, false); }
Dyadic& Dyadic::operator-=(const Dyadic& other) { return *this = sum(*this, other, true); }
Dyadic& Dyadic::operator*=(const Dyadic& other) { return *this = *this * other; }

Dyadic operator*(const Dyadic& a, const Dyadic& b) {
  Dyadic result;
  if (a.mantissa_.is_zero() || b.mantissa_.is_zero()) return result;
  result.mantissa_ = a.mantissa_ * b.mantissa_;  // odd times odd
  result.exponent_ = a.exponent_ + b.exponent_;
  return result;
}

std::strong_ordering operator<=>(const Dyadic& a, const Dyadic& b) {
  const int sa = a.sign();
  const int sb = b.sign();
  if (sa != sb || sa == 0) return sa <=> sb;
  const std::int64_t ta = a.exponent_ + static_cast<std::int64_t>(a.bits());
  const std::int64_t tb = b.exponent_ + static_cast<std::int64_t>(b.bits());
  if (ta != tb) return sa > 0 ? ta <=> tb : tb <=> ta;
  return (a - b).sign() <=> 0;
}

}  // namespace holdfast::exact
