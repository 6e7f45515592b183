#include "exact/volume.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace holdfast::exact {
namespace {

constexpr double kHalfUlp = 0x1p-53;
// The loss of products that underflow; coordinates are near one.
constexpr double kUnderflow = 0x1p-1060;
// The bounds are themselves computed in doubles.
constexpr double kRoundedUp = 1 + 0x1p-40;

}  // namespace

Bounded& Bounded::operator+=(const Bounded& other) {
  value += other.value;
  error = (error + other.error + kHalfUlp * std::abs(value)) * kRoundedUp;
  return *this;
}

Bounded bounded_determinant(const std::array<double, 3>& a, const std::array<double, 3>& b,
                            const std::array<double, 3>& c, const std::array<double, 3>& d) {
  std::array<double, 3> u{}, v{}, w{};
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
    w[k] = d[k] - a[k];
  }
  Bounded out;
  double permanent = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double plus = v[i] * w[j], minus = v[j] * w[i];
    out.value += u[k] * (plus - minus);
    permanent += std::abs(u[k]) * (std::abs(plus) + std::abs(minus));
  }
  out.error = ((7 + 56 * kHalfUlp) * kHalfUlp * permanent) * kRoundedUp + kUnderflow;
  return out;
}

// Coordinates far from one over- or underflow; then the bounds do not decide.
bool is_volume_above(const std::array<double, 3>& a, const std::array<double, 3>& b,
                     const std::array<double, 3>& c, const std::array<double, 3>& d, double most) {
  const Bounded six = bounded_determinant(a, b, c, d);
  const Bounded limit{6 * most, 6 * most * kHalfUlp * kRoundedUp + kUnderflow};
  if (six.surely_below(limit)) return false;
  if (limit.surely_below(six)) return true;
  const auto exact = [](const std::array<double, 3>& p) { return ExactPoint{{p[0], p[1], p[2]}}; };
  return determinant(exact(a), exact(b), exact(c), exact(d)) > Dyadic(6.0) * Dyadic(most);
}

Dyadic determinant(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, const ExactPoint& d) {
  std::array<std::array<Dyadic, 3>, 3> m;
  for (std::size_t k = 0; k < 3; ++k) {
    m[0][k] = b.c[k] - a.c[k];
    m[1][k] = c.c[k] - a.c[k];
    m[2][k] = d.c[k] - a.c[k];
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) +
         m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

}  // namespace holdfast::exact
