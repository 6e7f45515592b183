// Exact binary fractions m * 2^e.
#include "exact/dyadic.h"

#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace holdfast::exact {
namespace {

using Limb = boost::multiprecision::limb_type;
constexpr std::size_t kLimbBits = std::numeric_limits<Limb>::digits;

std::size_t magnitude_bits(const BigInt& m) {
  const auto& backend = m.backend();
  const std::size_t last = backend.size() - 1;
  return last * kLimbBits + static_cast<std::size_t>(std::bit_width(backend.limbs()[last]));
}

std::size_t trailing_zeros(const BigInt& m) {
  const auto* limbs = m.backend().limbs();
  std::size_t i = 0;
  while (limbs[i] == 0) ++i;
  return i * kLimbBits + static_cast<std::size_t>(std::countr_zero(limbs[i]));
}

std::uint64_t magnitude_window(const BigInt& m, std::size_t at) {
  const auto* limbs = m.backend().limbs();
  const std::size_t size = m.backend().size();
  std::uint64_t result = 0;
  for (std::size_t i = at / kLimbBits; i < size && i * kLimbBits < at + 64; ++i) {
    const std::size_t position = i * kLimbBits;
    const auto limb = static_cast<std::uint64_t>(limbs[i]);
    result |= position >= at ? limb << (position - at) : limb >> (at - position);
  }
  return result;
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

Dyadic::Dyadic(double value) {
  if (value == 0) return;
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  auto integer = static_cast<std::int64_t>(std::ldexp(fraction, 53));
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(integer));
  integer >>= zeros;
  mantissa_ = integer;
  exponent_ = exponent - 53 + zeros;
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
  // Towards zero and minus infinity agree, since only zeros are shifted out.
  mantissa_ >>= zeros;
  exponent_ += static_cast<std::int64_t>(zeros);
}

std::size_t Dyadic::bits() const { return magnitude_bits(mantissa_); }

std::uint64_t Dyadic::window(std::size_t at) const { return magnitude_window(mantissa_, at); }

double Dyadic::to_double() const {
  if (mantissa_.is_zero()) return 0;
  const double sign = mantissa_.sign() < 0 ? -1.0 : 1.0;
  const auto size = static_cast<std::int64_t>(bits());
  const std::int64_t top = exponent_ + size - 1;
  if (top > 1023) return sign * std::numeric_limits<double>::infinity();
  const std::int64_t precision = top >= -1022 ? 53 : top + 1075;
  if (precision < 0) return sign * 0.0;
  const std::int64_t dropped = size - precision;
  if (dropped <= 0) {
    return sign * std::ldexp(static_cast<double>(window(0)), static_cast<int>(exponent_));
  }
  const auto position = static_cast<std::size_t>(dropped);
  std::uint64_t kept = precision == 0 ? 0 : window(position);
  const bool half = (window(position - 1) & 1) != 0;
  // The mantissa is odd: when two bits or more are dropped, the lowest of them is set, so no tie.
  if (half && (dropped >= 2 || (kept & 1) != 0)) ++kept;
  return sign * std::ldexp(static_cast<double>(kept), static_cast<int>(exponent_ + dropped));
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
  result.mantissa_.backend().negate();
  return result;
}

Dyadic& Dyadic::operator+=(const Dyadic& other) { return *this = *this + other; }
Dyadic& Dyadic::operator-=(const Dyadic& other) { return *this = *this - other; }
Dyadic& Dyadic::operator*=(const Dyadic& other) { return *this = *this * other; }

Dyadic operator+(const Dyadic& a, const Dyadic& b) {
  if (a.mantissa_.is_zero()) return b;
  if (b.mantissa_.is_zero()) return a;
  if (a.exponent_ < b.exponent_) return b + a;
  BigInt aligned = a.mantissa_ << static_cast<std::size_t>(a.exponent_ - b.exponent_);
  aligned += b.mantissa_;
  return {std::move(aligned), b.exponent_};
}

Dyadic operator-(const Dyadic& a, const Dyadic& b) { return a + -b; }

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
