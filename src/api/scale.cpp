#include "api/scale.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "exact/float_bits.h"

namespace holdfast {
namespace {

constexpr int kUsual = 64;  // 2^-64 .. 2^64: products of sixteen differences do not overflow or underflow
constexpr int kRoom = 160;  // bits that added vertices may have below the last bit of any coordinate

// The exponent of the last set bit of all nonzero coordinates.
int least_bit(std::span<const Point> vertices) {
  int least = 1024;
  for (const Point& p : vertices)
    for (const double x : p) {
      if (x == 0) continue;
      const exact::FloatParts parts = exact::float_parts(exact::magnitude_bits(x));
      least = std::min(least, parts.exponent + std::countr_zero(parts.mantissa));
    }
  return least;
}

}  // namespace

// Scaling up is always exact. Scaling down is exact while no last bit becomes denormal, and must leave room
// below it for the bits of added vertices.
int choose_scale(std::span<const Point> vertices) {
  double largest = 0;
  for (const Point& p : vertices)
    for (const double x : p) largest = std::max(largest, std::abs(x));
  if (largest == 0) return 0;
  const int k = -std::ilogb(largest);
  if (std::abs(k) <= kUsual) return 0;
  return k > 0 ? k
               : std::max(k, std::min(0, exact::DoubleGrid::kLeastExponent + kRoom - least_bit(vertices)));
}

exact::DoubleGrid grid_after(int k) {
  return k > 0 ? exact::DoubleGrid(exact::DoubleGrid::kLeastExponent + k) : exact::DoubleGrid();
}

Point scaled(const Point& p, int k) {
  return {std::ldexp(p[0], k), std::ldexp(p[1], k), std::ldexp(p[2], k)};
}

std::vector<Point> scaled(std::span<const Point> points, int k) {
  std::vector<Point> out(points.size());
  std::transform(points.begin(), points.end(), out.begin(), [k](const Point& p) { return scaled(p, k); });
  return out;
}

exact::ExactPoint scaled(const exact::ExactPoint& p, int k) {
  return {{p.c[0].scaled(k), p.c[1].scaled(k), p.c[2].scaled(k)}};
}

}  // namespace holdfast
