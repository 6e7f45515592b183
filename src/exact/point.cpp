// Points: explicit or exact.
#include "exact/point.h"

#include <cmath>

namespace holdfast::exact {
namespace {

Dyadic coordinate(PointRef p, std::size_t i) {
  return p.exact != nullptr ? p.exact->c[i] : Dyadic(p.approx[i]);
}

TwoTerms two_doubles(PointRef p, std::size_t i) {
  return p.exact != nullptr ? p.exact->c[i].to_two_doubles() : TwoTerms{p.approx[i], 0};
}

/// a - b. A sum of pairs of doubles errs by at most 2^-103 size, size = |a| + |b|. That is below 2^-54 of the
/// result unless 49 leading bits cancel.
double coordinate_difference(PointRef a, PointRef b, std::size_t i) {
  const double size = std::fabs(a.approx[i]) + std::fabs(b.approx[i]);
  if (size > 0x1p-800 && size < 0x1p1000) {
    const TwoTerms at = two_doubles(a, i), bt = two_doubles(b, i);
    const TwoTerms high = two_diff(at.high, bt.high);
    const double result = high.high + (high.low + (at.low - bt.low));
    if (std::fabs(result) > 0x1p-49 * size) return result;
  }
  return (coordinate(a, i) - coordinate(b, i)).to_double();
}

}  // namespace

ExactPoint lift(const double* p) { return {{Dyadic(p[0]), Dyadic(p[1]), Dyadic(p[2])}}; }

ExactPoint lift(PointRef p) { return p.exact != nullptr ? *p.exact : lift(p.approx); }

void difference(PointRef a, PointRef b, double out[3]) {
  if (a.exact == nullptr && b.exact == nullptr) {
    for (int i = 0; i < 3; ++i) out[i] = a.approx[i] - b.approx[i];  // IEEE rounds the exact difference
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) out[i] = coordinate_difference(a, b, i);
}

}  // namespace holdfast::exact
