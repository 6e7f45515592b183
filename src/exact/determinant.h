// The determinants of the predicates over any exact ring: fixed-width integers, expansions, unbounded
// integers. Widths grow through the types of the results.
#pragma once

#include <array>

namespace holdfast::exact {

template <class T>
using Row = std::array<T, 3>;

/// u0 v1 - v0 u1.
template <class T>
[[nodiscard]] auto minor01(const Row<T>& u, const Row<T>& v) {
  return u[0] * v[1] - v[0] * u[1];
}

/// The cross product of numbers whose type holds their products.
template <class T>
[[nodiscard]] Row<T> cross(const Row<T>& u, const Row<T>& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// Sign of the determinant of rows u, v.
template <class T>
[[nodiscard]] int sign_det2(const std::array<T, 2>& u, const std::array<T, 2>& v) {
  return (u[0] * v[1] - v[0] * u[1]).sign();
}

/// The determinant of rows u, v, w.
template <class T>
[[nodiscard]] auto det3(const Row<T>& u, const Row<T>& v, const Row<T>& w) {
  return minor01(v, w) * u[2] + minor01(w, u) * v[2] + minor01(u, v) * w[2];
}

/// Its sign.
template <class T>
[[nodiscard]] int sign_det3(const Row<T>& u, const Row<T>& v, const Row<T>& w) {
  return det3(u, v, w).sign();
}

/// |u|^2.
template <class T>
[[nodiscard]] auto square(const Row<T>& u) {
  return u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
}

/// Sign of the determinant that decides incircle: rows of the differences a - d, b - d, c - d.
template <class T>
[[nodiscard]] int sign_incircle(const std::array<std::array<T, 2>, 3>& p) {
  const auto minor = [&](std::size_t i, std::size_t j) { return p[i][0] * p[j][1] - p[j][0] * p[i][1]; };
  const auto square = [&](std::size_t i) { return p[i][0] * p[i][0] + p[i][1] * p[i][1]; };
  return (minor(1, 2) * square(0) + minor(2, 0) * square(1) + minor(0, 1) * square(2)).sign();
}

/// Sign of the determinant that decides insphere: rows p of the differences a - e, b - e, c - e, d - e.
template <class T>
[[nodiscard]] int sign_insphere(const std::array<Row<T>, 4>& p) {
  const auto ab = minor01(p[0], p[1]);
  const auto bc = minor01(p[1], p[2]);
  const auto cd = minor01(p[2], p[3]);
  const auto da = minor01(p[3], p[0]);
  const auto ac = minor01(p[0], p[2]);
  const auto bd = minor01(p[1], p[3]);
  const auto abc = bc * p[0][2] - ac * p[1][2] + ab * p[2][2];
  const auto bcd = cd * p[1][2] - bd * p[2][2] + bc * p[3][2];
  const auto cda = da * p[2][2] + ac * p[3][2] + cd * p[0][2];
  const auto dab = ab * p[3][2] + bd * p[0][2] + da * p[1][2];
  return ((dab * square(p[2]) - abc * square(p[3])) + (bcd * square(p[0]) - cda * square(p[1]))).sign();
}

}  // namespace holdfast::exact
