// Exact binary fractions m * 2^e: the only numbers that coordinates are made of.
//
// Sums, differences and products of doubles are binary fractions again, and so is every point that
// Holdfast makes: A + t (B - A) on a segment, A + u (B - A) + v (C - A) in a facet, with t, u, v short
// binary fractions. No division occurs, hence no general rational.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>

namespace holdfast::exact {

/// Unbounded integer; up to 512 bits live inside the object, without allocation.
using BigInt = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<512, 0, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked, std::allocator<std::uint64_t>>,
    boost::multiprecision::et_off>;

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
  [[nodiscard]] std::size_t bits() const;
  /// Bits [at, at + 64) of |mantissa|; zeros beyond its end.
  [[nodiscard]] std::uint64_t window(std::size_t at) const;
  /// The nearest double, ties to even; infinity beyond the range, denormals where needed.
  [[nodiscard]] double to_double() const;
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

  friend Dyadic operator+(const Dyadic& a, const Dyadic& b);
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b);
  friend Dyadic operator*(const Dyadic& a, const Dyadic& b);
  friend bool operator==(const Dyadic& a, const Dyadic& b) {
    return a.exponent_ == b.exponent_ && a.mantissa_ == b.mantissa_;
  }
  friend std::strong_ordering operator<=>(const Dyadic& a, const Dyadic& b);

 private:
  void normalise();

  BigInt mantissa_;
  std::int64_t exponent_ = 0;
};

}  // namespace holdfast::exact
