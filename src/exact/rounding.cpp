#include "exact/rounding.h"

#include <algorithm>

namespace holdfast::exact {

std::int64_t top_exponent(const Dyadic& x) { return x.exponent() + static_cast<std::int64_t>(x.bits()) - 1; }

Dyadic rounded_to(const Dyadic& x, std::int64_t grid) {
  const std::int64_t drop = grid - x.exponent();
  if (drop <= 0 || x.sign() == 0) return x;
  if (drop > static_cast<std::int64_t>(x.bits()) + 1) return {};
  BigInt m = abs(x.mantissa());
  m += BigInt(1) << static_cast<unsigned>(drop - 1);
  m >>= static_cast<unsigned>(drop);
  return {x.sign() < 0 ? BigInt(-m) : m, grid};
}

Dyadic quotient(const Dyadic& a, const Dyadic& b, int bits) {
  if (a.sign() == 0) return {};
  const std::int64_t shift = std::max<std::int64_t>(
      0, bits + 2 + static_cast<std::int64_t>(b.bits()) - static_cast<std::int64_t>(a.bits()));
  BigInt q = (abs(a.mantissa()) << static_cast<unsigned>(shift)) / abs(b.mantissa());
  if (a.sign() * b.sign() < 0) q = -q;
  const Dyadic value(std::move(q), a.exponent() - b.exponent() - shift);
  return value.sign() == 0 ? value : rounded_to(value, top_exponent(value) - bits - 1);
}

Dyadic shortest_between(const Dyadic& low, const Dyadic& high) {
  if (low.sign() <= 0 && high.sign() >= 0) return {};
  // 2^g <= high - low: a multiple of 2^g lies in between. The coarsest possible grid may be one step above.
  for (std::int64_t grid = top_exponent(high - low) + 1;; --grid) {
    Dyadic middle = rounded_to((low + high).scaled(-1), grid);
    if (low <= middle && middle <= high) return middle;
  }
}

}  // namespace holdfast::exact
