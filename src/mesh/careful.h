// Normals and volumes that are right to a few digits however much their terms cancel: where floating point is
// not enough, exact differences and products are used. They measure thin elements and decide nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "holdfast/types.h"
#include "numbers/vector.h"

namespace holdfast::careful {

/// (b - a) x (c - a), of length twice the area.
[[nodiscard]] Vector normal(const Point& a, const Point& b, const Point& c);

/// det(b - a, c - a, d - a), where `n` is the normal of abc.
[[nodiscard]] double six_volumes(const Point& a, const Point& b, const Point& c, const Point& d,
                                 const Vector& n);

/// Points times the power of two that keeps products of coordinates in range; quality and angles stay.
template <std::size_t size>
[[nodiscard]] std::array<Point, size> brought_in_range(std::array<Point, size> points) {
  double top = 0;
  for (const Point& p : points)
    for (const double x : p) top = std::max(top, std::abs(x));
  constexpr int kUsual = 200;
  if (top == 0 || !std::isfinite(top) || std::abs(std::ilogb(top)) <= kUsual) return points;
  const int k = -std::ilogb(top);
  for (Point& p : points)
    for (double& x : p) x = std::ldexp(x, k);
  return points;
}

}  // namespace holdfast::careful
