// The in-circle predicate of the plane: an exact sign, decided by the cheapest tier that can.
//
// Tiers: a floating-point filter (inline, here), fixed-width integers, unbounded integers. Coordinates must
// be finite; any finite magnitude is answered rightly.
#pragma once

#include <cmath>

#include "exact/predicates.h"

namespace holdfast::exact {

namespace detail {

[[nodiscard]] int incircle_slow(const double* a, const double* b, const double* c, const double* d);

/// Decides incircle in floating point: +1 or -1, or 0 where it cannot tell.
///
/// Error bound: (10 + 96 eps) eps times the permanent (Shewchuk 1997, section 4.4). Besides, each product of
/// two differences may err by 2^-1075 by underflow, magnified by a square or a minor, and the three last
/// products by as much: 2^-900 in place of 2^-1073 leaves ample room. An overflow makes the bound infinite or
/// NaN, and no comparison with it holds.
[[nodiscard]] inline int incircle_filter(const double* a, const double* b, const double* c, const double* d) {
  const double ax = a[0] - d[0], ay = a[1] - d[1];
  const double bx = b[0] - d[0], by = b[1] - d[1];
  const double cx = c[0] - d[0], cy = c[1] - d[1];
  const double bxcy = bx * cy, cxby = cx * by, cxay = cx * ay, axcy = ax * cy, axby = ax * by, bxay = bx * ay;
  const double a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  const double det = a2 * (bxcy - cxby) + b2 * (cxay - axcy) + c2 * (axby - bxay);
  // The permanent is at most S^2 / 3, with S the sum of the squares a2, b2 and c2 (Cauchy-Schwarz, and the
  // inequality of the means twice); 4 eps S^2 leaves a sixth for the roundings of the bound. It decides most.
  const double squares = a2 + b2 + c2;
  const double rough = 4 * kEpsilon * squares * squares + 0x1p-900;
  if (std::fabs(det) > rough) [[likely]]
    return det > 0 ? 1 : -1;
  const double ma = std::fabs(bxcy) + std::fabs(cxby), mb = std::fabs(cxay) + std::fabs(axcy),
               mc = std::fabs(axby) + std::fabs(bxay);
  const double permanent = ma * a2 + mb * b2 + mc * c2;
  const double room = 0x1p-900 + 0x1p-900 * ((ma + mb + mc) + squares);
  return filtered_sign(det, (10 + 128 * kEpsilon) * kEpsilon * permanent + room);
}

}  // namespace detail

/// +1 where d lies strictly inside the circle through the positive (left-turning) triangle abc, 0 on it, -1
/// outside.
///
/// Laws: (1) swapping two of a, b, c negates; (2) swapping d with one of them negates too; (3) translation
/// and scaling by powers of two, where exact, change nothing; (4) a repeated point gives 0.
[[nodiscard]] inline int incircle(const double* a, const double* b, const double* c, const double* d) {
  const int sign = detail::incircle_filter(a, b, c, d);
  return sign != 0 ? sign : detail::incircle_slow(a, b, c, d);
}

}  // namespace holdfast::exact
