// Points of the plane with rational coordinates, such as the crossing of two segments, and the signs that
// they give.
//
// Homogeneous integers (x, y, w) with w > 0 stand for (x / w, y / w): every sign is that of a polynomial in
// them, so that no division occurs.
#pragma once

#include <array>

#include "exact/dyadic.h"

namespace holdfast::exact {

struct RationalPoint {
  BigInt x, y, w;  ///< w > 0
};

/// The point with these doubles as its coordinates, exactly.
[[nodiscard]] RationalPoint rational_point(const double* p);
/// The point where the lines ab and cd cross; these must not be parallel.
[[nodiscard]] RationalPoint crossing(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c,
                                     const RationalPoint& d);
/// The doubles nearest to the coordinates, ties to even; infinity beyond the range.
[[nodiscard]] std::array<double, 2> nearest(const RationalPoint& p);

/// The double nearest to n / d, ties to even, with d > 0; infinity beyond the range.
[[nodiscard]] double nearest_quotient(const BigInt& n, const BigInt& d);

/// The double nearest to n / d - high, give or take 2^-100 |high|, where `high` is the double nearest to n /
/// d; NaN where something would over- or underflow.
[[nodiscard]] double rest_of_quotient(const BigInt& n, const BigInt& d, double high);

/// As the predicates on doubles.
[[nodiscard]] int orient2d(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c);
[[nodiscard]] int incircle(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c,
                           const RationalPoint& d);
/// Sign of a - b in lexicographic order.
[[nodiscard]] int compare(const RationalPoint& a, const RationalPoint& b);
/// Sign of det(b - a, d - c): which of c and d lies further to the left of the line ab (+1: d).
[[nodiscard]] int compare_heights(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c,
                                  const RationalPoint& d);

}  // namespace holdfast::exact
