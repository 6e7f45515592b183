#include "api/scale.h"

#include <algorithm>
#include <cmath>

namespace holdfast {
namespace {

constexpr int kUsual = 64;  // 2^-64 .. 2^64: products of sixteen differences neither over- nor underflow
constexpr int kLeastBit = -1074;  // of any double
constexpr int kRoomBehind = 300;  // bits behind the leading one that added vertices may use

}  // namespace

int choose_scale(std::span<const Point> vertices) {
  double largest = 0;
  for (const Point& p : vertices)
    for (const double x : p) largest = std::max(largest, std::abs(x));
  if (largest == 0) return 0;
  const int k = -std::ilogb(largest);
  if (std::abs(k) <= kUsual || -kRoomBehind - k < kLeastBit) return 0;
  const bool exact = std::all_of(vertices.begin(), vertices.end(),
                                 [k](const Point& p) { return scaled(scaled(p, k), -k) == p; });
  return exact ? k : 0;
}

Point scaled(const Point& p, int k) {
  return {std::ldexp(p[0], k), std::ldexp(p[1], k), std::ldexp(p[2], k)};
}

exact::ExactPoint scaled(const exact::ExactPoint& p, int k) {
  return {{p.c[0].scaled(k), p.c[1].scaled(k), p.c[2].scaled(k)}};
}

}  // namespace holdfast
