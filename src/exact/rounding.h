// Short binary fractions near given ones: where exact arithmetic may choose, it chooses few bits.
#pragma once

#include "exact/dyadic.h"

namespace holdfast::exact {

/// The exponent of the leading bit: 2^e <= |x| < 2^(e+1). x must not be zero.
[[nodiscard]] std::int64_t top_exponent(const Dyadic& x);

/// The multiple of 2^grid nearest to x, ties away from zero.
[[nodiscard]] Dyadic rounded_to(const Dyadic& x, std::int64_t grid);

/// a / b to within a relative error of 2^-bits; b must not be zero.
[[nodiscard]] Dyadic quotient(const Dyadic& a, const Dyadic& b, int bits);

/// The binary fraction with the fewest bits after the point in the closed interval [low, high],
/// low < high.
[[nodiscard]] Dyadic shortest_between(const Dyadic& low, const Dyadic& high);

}  // namespace holdfast::exact
