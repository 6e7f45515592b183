// The doubles that a coordinate may have: all of them, or the multiples of a power of two.
//
// A mesh that stands for another one times 2^k, k > 0, has coordinates that are doubles when divided by 2^k
// again only if they are multiples of 2^(k - 1074): the spacing of the denormals does not shrink.
#pragma once

#include <cmath>
#include <limits>

#include "exact/dyadic.h"
#include "exact/float_bits.h"

namespace holdfast::exact {

class DoubleGrid {
 public:
  static constexpr int kLeastExponent = -1074;

  /// All doubles.
  DoubleGrid() = default;
  /// The doubles that are multiples of 2^exponent; below the normal range, all doubles.
  explicit DoubleGrid(int exponent)
      : exponent_(exponent < kLeastNormal ? kLeastExponent : exponent), step_(power_of(exponent_)) {}

  [[nodiscard]] bool is_every_double() const { return exponent_ == kLeastExponent; }
  /// All of its points are multiples of 2^exponent().
  [[nodiscard]] int exponent() const { return exponent_; }

  /// The point nearest to x, ties to even.
  [[nodiscard]] double nearest(double x) const {
    if (is_every_double() || !(std::fabs(x) < kHidden * step_)) return x;
    const double large = std::copysign(kHidden * step_, x);  // the doubles beyond it are step_ apart
    return (x + large) - large;
  }
  /// The point after x, itself one, towards plus or minus infinity.
  [[nodiscard]] double next(double x, bool up) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double y = std::nextafter(x, up ? kInfinity : -kInfinity);
    return is_every_double() || std::fabs(y - x) >= step_ ? y : up ? x + step_ : x - step_;
  }
  [[nodiscard]] bool holds(double x) const { return nearest(x) == x; }
  [[nodiscard]] bool holds(const Dyadic& x) const {
    return x.is_double() && (is_every_double() || x.sign() == 0 || x.exponent() >= exponent_);
  }

 private:
  static constexpr int kLeastNormal = -1022;
  static constexpr double kHidden = 0x1p52;
  [[nodiscard]] static double power_of(int exponent) {
    return exponent == kLeastExponent ? std::numeric_limits<double>::denorm_min() : power_of_two(exponent);
  }

  int exponent_ = kLeastExponent;
  double step_ = std::numeric_limits<double>::denorm_min();
};

}  // namespace holdfast::exact
