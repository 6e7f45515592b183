// Elementary functions that give the same bits everywhere.
//
// Additions, multiplications, divisions and square roots are exact but for one rounding that IEEE 754 defines
// (contraction is off); the functions of <cmath> beyond them differ in the last bits between C libraries,
// their versions and processors. Where a bit may decide which way a mesh goes, these are used: arguments
// reduced by constants in two parts, then polynomials (Muller 2016, Elementary Functions). Their errors are
// below one unit in the last place for exp, log and cbrt, below three for the others; the unit test compares
// them with wider numbers.
#pragma once

#include <array>

namespace holdfast::numbers {

[[nodiscard]] double exp(double x);
/// NaN for x < 0.
[[nodiscard]] double log(double x);
[[nodiscard]] double cbrt(double x);
/// The root of the sum of squares. If a square or the sum would leave the range of doubles, the arguments are
/// first scaled by a power of two.
[[nodiscard]] double hypot(double x, double y);
[[nodiscard]] double hypot(double x, double y, double z);
/// The distance of two points anywhere in the range of doubles.
[[nodiscard]] inline double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// For angles in radians, up to some thousands.
[[nodiscard]] double sin(double x);
[[nodiscard]] double cos(double x);
/// The angle of (x, y) in radians, from -pi to pi.
[[nodiscard]] double atan2(double y, double x);
/// For numbers from -1 to 1.
[[nodiscard]] double acos(double x);

}  // namespace holdfast::numbers
