// Determinants as numbers, not only as signs: the roots that the partition slides its points between.
#pragma once

#include "exact/point.h"

namespace holdfast::exact {

/// det(b-a, c-a, d-a), exactly: six times the signed volume.
[[nodiscard]] Dyadic determinant(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c,
                                 const ExactPoint& d);

}  // namespace holdfast::exact
