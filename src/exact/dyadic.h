// Exact binary fractions m * 2^e: the only numbers that coordinates are made of.
//
// Sums, differences and products of doubles are binary fractions again, and so is every point that
// Holdfast makes: A + t (B - A) on a segment, A + u (B - A) + v (C - A) in a facet, with t, u, v short
// binary fractions. No division occurs, hence no general rational.
#pragma once

#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>

#include "exact/expansion.h"

namespace holdfast::exact {

/// Unbounded integer; up to 512 bits live inside the object, without allocation.
using BigInt = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<512, 0, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked, std::allocator<char>>,
    boost::multiprecision::et_off>;

/// A digit of a BigInt's magnitude.
using Limb = boost::multiprecision::limb_type;
static_assert(sizeof(Limb) == 8, "needs a 128-bit integer type");

/// The largest k such that 2^k divides m, which is not 0.
[[nodiscard]] std::size_t trailing_zeros(const BigInt& m);

/// An exact binary fraction m * 2^e. Invariant: m is odd, or m = 0 and e = 0; so equal values have
/// equal representations.
class Dyadic {
 public:
  Dyadic() = default;
  /// The value of a finite double, exactly. Implicit: it loses nothing.
  Dyadic(double value);  // NOLINT(google-explicit-constructor)
  /// mantissa * 2^exponent.
  Dyadic(BigInt mantissa, std::int64_t exponent);

  [[nodiscard]] const BigInt& mantissa() const { return mantissa_; }
  [[nodiscard]] std::int64_t exponent() const { return exponent_; }

  /// -1, 0 or +1.
  [[nodiscard]] int sign() const { return mantissa_.sign(); }
  /// Number of bits of |mantissa|; 0 for zero.
  [[nodiscard]] std::size_t bits() const {
    const std::size_t last = mantissa_.backend().size() - 1;
    return 64 * last + static_cast<std::size_t>(std::bit_width(Limb{limbs()[last]}));
  }
  /// |mantissa|, least significant limb first, ceil(bits() / 64) of them (one at least).
  [[nodiscard]] const Limb* limbs() const { return mantissa_.backend().limbs(); }
  /// The nearest double, ties to even; infinity beyond the range, denormals where needed.
  [[nodiscard]] double to_double() const;
  /// Two doubles whose sum has a relative error of at most 2^-105, or an absolute one of at most 2^-1075
  /// where that is more; for values below 2^1023. The second is at most half an ulp of the first.
  [[nodiscard]] TwoTerms to_two_doubles() const;
  /// Whether some finite double has exactly this value.
  [[nodiscard]] bool is_double() const;
  /// "m*2^e" in decimal.
  [[nodiscard]] std::string to_string() const;
  /// Times 2^k.
  [[nodiscard]] Dyadic scaled(std::int64_t k) const;

  Dyadic operator-() const;
  Dyadic& operator+=(const Dyadic& other);
  Dyadic& operator-=(const Dyadic& other);
  Dyadic& operator*=(const Dyadic& other);

  friend Dyadic operator+(const Dyadic& a, const Dyadic& b) { return sum(a, b, false); }
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b) { return sum(a, b, true); }
  friend Dyadic operator*(const Dyadic& a, const Dyadic& b);
  friend bool operator==(const Dyadic& a, const Dyadic& b) {
    return a.exponent_ == b.exponent_ && a.mantissa_ == b.mantissa_;
  }
  friend std::strong_ordering operator<=>(const Dyadic& a, const Dyadic& b);

 private:
  [[nodiscard]] static Dyadic sum(const Dyadic& a, const Dyadic& b, bool negate_b);
  void normalise();

  BigInt mantissa_;
  std::int64_t exponent_ = 0;
};

}  // namespace holdfast::exact
