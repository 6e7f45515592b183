#include "api/scale.h"

#include <algorithm>
#include <cmath>

namespace holdfast {
namespace {

constexpr int kUsual = 200;       // 2^-200 .. 2^200: products of five differences neither over- nor underflow
constexpr int kLeastBit = -1074;  // of any double
constexpr int kRoomBehind = 300;  // bits behind the leading one that added vertices may use

}  // namespace

int choose_scale(std::span<const Point> vertices) {
  int top = 0;    // exponent of the largest magnitude
  int least = 0;  // exponent below which no coordinate has a bit
  bool any = false;
  for (const Point& p : vertices)
    for (const double x : p) {
      if (x == 0) continue;
      const int e = std::ilogb(x);
      const int bit = std::max(e - 52, kLeastBit);
      top = any ? std::max(top, e) : e;
      least = any ? std::min(least, bit) : bit;
      any = true;
    }
  if (!any || std::abs(top) <= kUsual) return 0;
  const int k = -top;
  const bool exact = least + k >= kLeastBit;
  const bool room = k < 0 || -kRoomBehind - k >= kLeastBit;
  return exact && room ? k : 0;
}

Point scaled(const Point& p, int k) {
  return {std::ldexp(p[0], k), std::ldexp(p[1], k), std::ldexp(p[2], k)};
}

exact::ExactPoint scaled(const exact::ExactPoint& p, int k) {
  return {{p.c[0].scaled(k), p.c[1].scaled(k), p.c[2].scaled(k)}};
}

}  // namespace holdfast
