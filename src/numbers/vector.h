// Vectors of three doubles. They measure and propose: no topology is decided by this floating-point
// arithmetic.
#pragma once

#include <array>
#include <cmath>

namespace holdfast {

using Vector = std::array<double, 3>;

[[nodiscard]] inline Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
[[nodiscard]] inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
[[nodiscard]] inline double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
[[nodiscard]] inline double length(const Vector& a) { return std::sqrt(dot(a, a)); }
[[nodiscard]] inline double distance(const Vector& a, const Vector& b) { return length(a - b); }

}  // namespace holdfast
