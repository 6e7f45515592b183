// Points of the plane with rational coordinates.
#include "exact/rational_point.h"

#include <algorithm>
#include <cmath>

#include "exact/determinant.h"
#include "exact/float_bits.h"
#include "numbers/float_environment.h"

namespace holdfast::exact {
namespace {

/// p - q as homogeneous integers, whose weight is positive.
RationalPoint difference(const RationalPoint& p, const RationalPoint& q) {
  return {p.x * q.w - q.x * p.w, p.y * q.w - q.y * p.w, p.w * q.w};
}

Row<BigInt> row(const RationalPoint& p) { return {p.x, p.y, p.w}; }

Row<BigInt> cross(const Row<BigInt>& u, const Row<BigInt>& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

std::int64_t bits(const BigInt& m) {
  return m.is_zero() ? 0 : static_cast<std::int64_t>(boost::multiprecision::msb(abs(m))) + 1;
}

}  // namespace

/// The quotient has 66 bits or more; a last bit that stands for the rest makes its rounding
/// that of the exact value.
double nearest_quotient(const BigInt& n, const BigInt& d) {
  if (n.is_zero()) return 0;
  const std::int64_t shift = std::max<std::int64_t>(0, 66 - (bits(n) - bits(d)));
  BigInt quotient, rest;
  divide_qr(BigInt(abs(n) << static_cast<std::size_t>(shift)), d, quotient, rest);
  quotient <<= 1;
  if (!rest.is_zero()) quotient += 1;
  return Dyadic(n.sign() < 0 ? BigInt(-quotient) : quotient, -shift - 1).to_double();
}

RationalPoint rational_point(const double* p) {
  const Dyadic x(p[0]), y(p[1]);
  const std::int64_t low = std::min({x.exponent(), y.exponent(), std::int64_t{0}});
  const auto scaled = [&](const Dyadic& value) {
    return BigInt(value.mantissa() << static_cast<std::size_t>(value.exponent() - low));
  };
  return {scaled(x), scaled(y), BigInt(1) << static_cast<std::size_t>(-low)};
}

RationalPoint crossing(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c,
                       const RationalPoint& d) {
  const Row<BigInt> p = cross(cross(row(a), row(b)), cross(row(c), row(d)));
  RationalPoint point{p[0], p[1], p[2]};
  if (point.w < 0) point = {-point.x, -point.y, -point.w};
  // In lowest terms, so that points on lines through such points do not grow more than they must.
  const BigInt common = gcd(gcd(abs(point.x), abs(point.y)), point.w);
  if (common > 1) point = {point.x / common, point.y / common, point.w / common};
  return point;
}

std::array<double, 2> nearest(const RationalPoint& p) {
  return {nearest_quotient(p.x, p.w), nearest_quotient(p.y, p.w)};
}

int orient2d(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  return sign_det3(row(a), row(b), row(c));
}

int incircle(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c, const RationalPoint& d) {
  const auto lifted = [&](const RationalPoint& p) {
    const RationalPoint u = difference(p, d);
    return Row<BigInt>{u.x * u.w, u.y * u.w, u.x * u.x + u.y * u.y};
  };
  return sign_det3(lifted(a), lifted(b), lifted(c));
}

int compare(const RationalPoint& a, const RationalPoint& b) {
  const RationalPoint u = difference(a, b);
  return u.x.sign() != 0 ? u.x.sign() : u.y.sign();
}

int compare_heights(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c,
                    const RationalPoint& d) {
  const RationalPoint u = difference(b, a), v = difference(d, c);
  return BigInt(u.x * v.y - u.y * v.x).sign();
}

}  // namespace holdfast::exact
