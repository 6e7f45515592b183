// Determinants as numbers, not only as signs: the roots that the partition slides its points between.
#pragma once

#include <array>

#include "exact/point.h"

namespace holdfast::exact {

/// A number that a computation in doubles missed by `error` at most.
struct Bounded {
  double value = 0;
  double error = 0;

  /// Sums miss what their terms missed, and what the addition rounded.
  Bounded& operator+=(const Bounded& other);
  /// Whether the exact number is below every one that the other may be. False where either is no number.
  [[nodiscard]] bool surely_below(const Bounded& other) const {
    return value + error < other.value - other.error;
  }
};

/// det(b-a, c-a, d-a) in doubles, with the error bound of the filter of orient3d (Shewchuk 1997,
/// section 4.3).
[[nodiscard]] Bounded bounded_determinant(const std::array<double, 3>& a, const std::array<double, 3>& b,
                                          const std::array<double, 3>& c, const std::array<double, 3>& d);

/// Whether the signed volume of a tetrahedron is more than that, exactly. All numbers are finite.
[[nodiscard]] bool is_volume_above(const std::array<double, 3>& a, const std::array<double, 3>& b,
                                   const std::array<double, 3>& c, const std::array<double, 3>& d,
                                   double most);

/// det(b-a, c-a, d-a), exactly: six times the signed volume.
[[nodiscard]] Dyadic determinant(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c,
                                 const ExactPoint& d);

}  // namespace holdfast::exact
