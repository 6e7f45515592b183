#include "numbers/elementary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace holdfast::numbers {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Constants in two parts: the first has so many zero bits at its end that its products with the small whole
// numbers of a reduction are exact.
constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;
constexpr double kHalfPiHigh = 0x1.921fb544p0, kHalfPiLow = 0x1.0b4611a626331p-34;

// sum of c[k] z^k
template <std::size_t size>
double polynomial(const std::array<double, size>& c, double z) {
  double sum = c[size - 1];
  for (std::size_t k = size - 1; k-- > 0;) sum = sum * z + c[k];
  return sum;
}

// first, first * ratio(1), first * ratio(1) * ratio(2), ...: the coefficients of Taylor series, each rounded
// a few times, of which the first ones, that count, are the least.
template <std::size_t size, typename Ratio>
constexpr std::array<double, size> series(double first, Ratio ratio) {
  std::array<double, size> c{};
  c[0] = first;
  for (std::size_t k = 1; k < size; ++k) c[k] = c[k - 1] * ratio(static_cast<double>(k));
  return c;
}
template <std::size_t size, typename Term>
constexpr std::array<double, size> terms(Term term) {
  std::array<double, size> c{};
  for (std::size_t k = 0; k < size; ++k) c[k] = term(static_cast<double>(k));
  return c;
}

double rounded(double x) { return std::floor(x + 0.5); }

// Both for |r| <= pi/4.
double sine_near_zero(double r) {
  static constexpr auto kSeries =
      series<8>(-1.0 / 6, [](double k) { return -1 / ((2 * k + 2) * (2 * k + 3)); });
  const double z = r * r;
  return r + r * (z * polynomial(kSeries, z));
}
double cosine_near_zero(double r) {
  static constexpr auto kSeries =
      series<8>(1.0 / 24, [](double k) { return -1 / ((2 * k + 3) * (2 * k + 4)); });
  const double z = r * r, half = 0.5 * z, main = 1 - half;
  return main + (((1 - main) - half) + z * (z * polynomial(kSeries, z)));
}

// The sine of x + quarters * pi/2.
double sine_ahead(double x, int quarters) {
  if (!std::isfinite(x)) return kNan;
  const double n = rounded(x * (2 / std::numbers::pi));
  const double r = (x - n * kHalfPiHigh) - n * kHalfPiLow;
  const double turns = (n + quarters) / 4;
  switch (static_cast<int>(4 * (turns - std::floor(turns)))) {
    case 0:
      return sine_near_zero(r);
    case 1:
      return cosine_near_zero(r);
    case 2:
      return -sine_near_zero(r);
    default:
      return -cosine_near_zero(r);
  }
}

// Of t from 0 to 1: by that of the nearest k/4, and a series for the rest, of an eighth at most.
double arctangent(double t) {
  static constexpr std::array<double, 5> kOfQuarters{0, 0.24497866312686414, 0.4636476090008061,
                                                     0.6435011087932844, 0.7853981633974483};
  static constexpr auto kSeries =
      terms<9>([](double k) { return (static_cast<int>(k) % 2 == 0 ? -1 : 1) / (2 * k + 3); });
  const double quarters = rounded(4 * t), c = quarters / 4;
  const double u = (t - c) / (1 + t * c), z = u * u;
  return kOfQuarters[static_cast<std::size_t>(quarters)] + (u + u * (z * polynomial(kSeries, z)));
}

}  // namespace

double exp(double x) {
  constexpr double kMost = 709.782712893384, kLeast = -745.1332191019412;
  static constexpr auto kSeries = series<12>(0.5, [](double k) { return 1 / (k + 2); });
  if (std::isnan(x)) return x;
  if (x > kMost) return kInfinity;
  if (x < kLeast) return 0;
  const double n = rounded(x * (1 / std::numbers::ln2));
  const double high = x - n * kLn2High, low = n * kLn2Low, r = high - low;
  const double rest = r * r * polynomial(kSeries, r);
  return std::ldexp(1 + (high + (rest - low)), static_cast<int>(n));
}

// log(m 2^e) by s = (m - 1) / (m + 1): log m = 2 (s + s^3/3 + s^5/5 + ...), and 2 s = (m - 1) - s (m - 1).
double log(double x) {
  static constexpr auto kSeries = terms<10>([](double k) { return 2 / (2 * k + 3); });
  if (!(x > 0)) return x == 0 ? -kInfinity : kNan;
  if (x == kInfinity) return x;
  int e = 0;
  double m = std::frexp(x, &e);
  if (m < std::numbers::sqrt2 / 2) {
    m *= 2;
    --e;
  }
  const double f = m - 1, s = f / (2 + f), z = s * s;
  const double n = e;
  return n * kLn2High + (f - (s * (f - z * polynomial(kSeries, z)) - n * kLn2Low));
}

// Halley's iteration, which triples the digits, from a line that is right to a tenth; Newton's step rounds
// last.
double cbrt(double x) {
  if (x == 0 || !std::isfinite(x)) return x;
  int e = 0;
  double m = std::frexp(std::abs(x), &e);
  const int third = static_cast<int>(std::floor(e / 3.0));
  for (int k = 3 * third; k < e; ++k) m *= 2;  // from 1/2 to 4
  double y = 0.68 + 0.2267 * m;
  for (int k = 0; k < 3; ++k) {
    const double cube = y * y * y;
    y *= (cube + 2 * m) / (2 * cube + m);
  }
  y -= (y - m / (y * y)) / 3;
  return std::copysign(std::ldexp(y, third), x);
}

double hypot(double x, double y, double z) {
  constexpr double kLeast = 1e-140, kMost = 1e150;
  const double top = std::max({std::abs(x), std::abs(y), std::abs(z)});
  if (top > kLeast && top < kMost) return std::sqrt(x * x + y * y + z * z);
  if (std::isinf(x) || std::isinf(y) || std::isinf(z)) return kInfinity;
  if (!(top > 0)) return x + y + z;  // zero, or NaN
  const int e = std::ilogb(top);
  const double u = std::ldexp(x, -e), v = std::ldexp(y, -e), w = std::ldexp(z, -e);
  return std::ldexp(std::sqrt(u * u + v * v + w * w), e);
}
double hypot(double x, double y) { return hypot(x, y, 0); }

double sin(double x) { return sine_ahead(x, 0); }
double cos(double x) { return sine_ahead(x, 1); }

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return kNan;
  const double a = std::abs(y), b = std::abs(x);
  const bool is_steep = a > b;
  double t = is_steep ? b / a : a / b;
  if (std::isnan(t)) t = a == 0 ? 0 : 1;  // both are zero, or infinite
  double angle = arctangent(t);
  if (is_steep) angle = kHalfPiHigh - (angle - kHalfPiLow);
  if (std::signbit(x)) angle = 2 * kHalfPiHigh - (angle - 2 * kHalfPiLow);
  return std::copysign(angle, y);
}

double acos(double x) { return atan2(std::sqrt((1 - x) * (1 + x)), x); }

}  // namespace holdfast::numbers
