// Points: explicit (three doubles) or exact (three binary fractions with their nearest doubles).
#pragma once

#include <array>

#include "exact/dyadic.h"

namespace holdfast::exact {

struct ExactPoint {
  std::array<Dyadic, 3> c;
};

/// A point as the predicates take it; a view that owns nothing.
///
/// `exact == nullptr`: the three doubles are the coordinates. Otherwise `exact` holds the coordinates
/// and `approx` the double nearest to each (Dyadic::to_double), which the filters rely on.
struct PointRef {
  const double* approx = nullptr;
  const ExactPoint* exact = nullptr;
};

/// The exact coordinates of a point.
[[nodiscard]] ExactPoint lift(const double* p);
[[nodiscard]] ExactPoint lift(PointRef p);

/// a - b with a relative error of at most 2^-52 in each coordinate (above the denormals), also where a
/// and b share all their leading bits; exact where the difference is 0.
void difference(PointRef a, PointRef b, double out[3]);

}  // namespace holdfast::exact
