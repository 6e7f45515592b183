// The projection of a plane along a coordinate axis.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "exact/predicates.h"
#include "holdfast/types.h"
#include "repair/near.h"

namespace holdfast::repairing {

/// The coordinate axis closest to the normal.
inline unsigned axis_of(const Vector& n) {
  unsigned axis = 0;
  for (unsigned k = 1; k < 3; ++k)
    if (std::fabs(n[k]) > std::fabs(n[axis])) axis = k;
  return axis;
}

/// A point in the projection along an axis.
inline std::array<double, 2> projected(const Point& p, unsigned axis) {
  return {p[(axis + 1) % 3], p[(axis + 2) % 3]};
}

/// The exact sign of the area of a triangle in the projection along an axis.
inline int turn_of(const Point& a, const Point& b, const Point& c, unsigned axis) {
  const std::array<double, 2> p = projected(a, axis), q = projected(b, axis), r = projected(c, axis);
  return exact::orient2d(p.data(), q.data(), r.data());
}

}  // namespace holdfast::repairing
