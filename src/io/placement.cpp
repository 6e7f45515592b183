#include "io/placement.h"

#include <numbers>

#include "numbers/elementary.h"

namespace holdfast::io {
namespace {

double sin_of_degrees(double degrees) {
  const double quarters = degrees / 90;
  for (const double whole : {-4, -3, -2, -1, 0, 1, 2, 3, 4, 5})
    if (quarters == whole) return std::array{0.0, 1.0, 0.0, -1.0}[static_cast<std::size_t>(whole + 4) % 4];
  return numbers::sin(degrees * std::numbers::pi / 180);
}

}  // namespace

Placement Placement::moved_by(const Point& shift) {
  Placement result;
  for (std::size_t axis = 0; axis < 3; ++axis) result.m[9 + axis] = shift[axis];
  return result;
}

// By Rodrigues' formula.
Placement Placement::turned(const Point& a, const Point& axis, double degrees) {
  const double s = sin_of_degrees(degrees), c = sin_of_degrees(degrees + 90);
  Placement turn;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t u = (i + 1) % 3, v = (i + 2) % 3;
    for (std::size_t j = 0; j < 3; ++j) turn.m[3 * i + j] = axis[i] * axis[j] * (1 - c) + (i == j ? c : 0);
    turn.m[3 * i + u] += axis[v] * s;
    turn.m[3 * i + v] -= axis[u] * s;
  }
  return moved_by(a).after(turn.after(moved_by({-a[0], -a[1], -a[2]})));
}

Point Placement::of(const Point& p) const {
  if (*this == Placement{}) return p;
  Point moved;
  for (std::size_t axis = 0; axis < 3; ++axis)
    moved[axis] = p[0] * m[axis] + p[1] * m[3 + axis] + p[2] * m[6 + axis] + m[9 + axis];
  return moved;
}

Placement Placement::after(const Placement& inner) const {
  Placement both;
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t axis = 0; axis < 3; ++axis)
      both.m[3 * row + axis] = inner.m[3 * row] * m[axis] + inner.m[3 * row + 1] * m[3 + axis] +
                               inner.m[3 * row + 2] * m[6 + axis] + (row == 3 ? m[9 + axis] : 0);
  return both;
}

bool Placement::mirrors() const {
  return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
             m[2] * (m[3] * m[7] - m[4] * m[6]) <
         0;
}

}  // namespace holdfast::io
