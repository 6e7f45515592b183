#include "check_repair/reach.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>

#include "numbers/elementary.h"

namespace holdfast::checking {
namespace {

using exact::Dyadic;
using ExactVector = std::array<Dyadic, 3>;

ExactVector difference(const Point& a, const Point& b) {
  return {Dyadic(a[0]) - Dyadic(b[0]), Dyadic(a[1]) - Dyadic(b[1]), Dyadic(a[2]) - Dyadic(b[2])};
}

Dyadic dot(const ExactVector& a, const ExactVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

ExactVector cross(const ExactVector& a, const ExactVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Rounded vectors, for steps that decide nothing or have an error bound.
template <class Real>
using Rounded = std::array<Real, 3>;

template <class Real>
Rounded<Real> minus(const Point& a, const Point& b) {
  return {Real{a[0]} - Real{b[0]}, Real{a[1]} - Real{b[1]}, Real{a[2]} - Real{b[2]}};
}
template <class Real>
Real dot(const Rounded<Real>& a, const Rounded<Real>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length(const Rounded<double>& a) { return numbers::hypot(a[0], a[1], a[2]); }
long double length(const Rounded<long double>& a) { return std::sqrt(dot(a, a)); }

/// Parameters of the point a + s u + t v of the triangle that is roughly nearest to a + w: s, t >= 0, s + t
/// <= 1.
template <class Real>
std::array<Real, 2> nearest_weights(const Rounded<Real>& u, const Rounded<Real>& v, const Rounded<Real>& w) {
  const Real uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const Real det = uu * vv - uv * uv;
  Real s = (uw * vv - vw * uv) / det, t = (vw * uu - uw * uv) / det;
  if (s >= 0 && t >= 0 && s + t <= 1) return {s, t};
  // Otherwise the best point of the three sides.
  const auto clamped = [](Real x) { return x > 0 ? std::min(x, Real{1}) : Real{0}; };
  const Real on_uv = clamped((vv - uv - uw + vw) / (uu - 2 * uv + vv));
  const std::array<std::array<Real, 2>, 3> sides{
      {{clamped(uw / uu), 0}, {0, clamped(vw / vv)}, {1 - on_uv, on_uv}}};
  Real best = std::numeric_limits<Real>::infinity();
  for (const auto& [x, y] : sides) {
    const Rounded<Real> r{w[0] - x * u[0] - y * v[0], w[1] - x * u[1] - y * v[1], w[2] - x * u[2] - y * v[2]};
    const Real square = dot(r, r);
    if (square < best) {
      best = square;
      s = x;
      t = y;
    }
  }
  return {s, t};
}

template <class Real>
Real residual(const Point& p, const std::array<Point, 3>& t, Real& scale) {
  const Rounded<Real> u = minus<Real>(t[1], t[0]), v = minus<Real>(t[2], t[0]), w = minus<Real>(p, t[0]);
  const auto [x, y] = nearest_weights(u, v, w);
  scale = length(u) + length(v) + length(w);
  return length(
      Rounded<Real>{w[0] - x * u[0] - y * v[0], w[1] - x * u[1] - y * v[1], w[2] - x * u[2] - y * v[2]});
}

/// Whether a point of the triangle is certainly near enough despite rounding: differences have a relative
/// error of half an ulp, and the residual is a sum of five terms, none larger than `scale`, with at most
/// three roundings each. Weights outside the triangle, or NaN, fail the comparison or go to the exact test.
template <class Real>
bool is_surely_near(const Point& p, const std::array<Point, 3>& t, double distance) {
  constexpr Real kEpsilon = std::numeric_limits<Real>::epsilon();
  Real scale = 0;
  const Real found = residual(p, t, scale);
  return found * (1 + 8 * kEpsilon) + 8 * kEpsilon * scale + Real{0x1p-1000} <= Real{distance};
}

template <class Real>
Rounded<Real> cross(const Rounded<Real>& a, const Rounded<Real>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Products of lengths this large do not underflow, so errors are relative to the products.
constexpr long double kSurelyNormal = 0x1p-900L;

/// Whether the line through a and b is certainly further away despite rounding: each coordinate of the cross
/// product has an error of a few units of the product of both lengths.
bool is_surely_far(const Point& p, const Point& a, const Point& b, double distance) {
  constexpr long double kError = 64 * std::numeric_limits<long double>::epsilon();
  const Rounded<long double> d = minus<long double>(b, a), w = minus<long double>(p, a);
  const long double size = length(d) * length(w), found = length(cross(w, d));
  return size > kSurelyNormal && found - kError * size > distance * length(d) * (1 + kError);
}

/// The same for the plane.
bool is_surely_far(const Point& p, const std::array<Point, 3>& t, double distance) {
  constexpr long double kError = 64 * std::numeric_limits<long double>::epsilon();
  const Rounded<long double> u = minus<long double>(t[1], t[0]), v = minus<long double>(t[2], t[0]),
                             w = minus<long double>(p, t[0]), n = cross(u, v);
  const long double area = length(u) * length(v), size = area * length(w), found = std::fabs(dot(w, n));
  return size > kSurelyNormal && area > kSurelyNormal &&
         found - kError * size > distance * (length(n) + kError * area) * (1 + kError);
}

}  // namespace

Reach::Reach(double distance) : distance_(distance), square_(Dyadic(distance) * Dyadic(distance)) {}

bool Reach::of_point(const Point& p, const Point& a) const {
  return p == a || compare_distance(p, a, distance_) <= 0;
}

bool Reach::of_segment(const Point& p, const Point& a, const Point& b) const {
  if (p == a || p == b) return true;
  if (distance_ == 0) return on_segment(p.data(), a.data(), b.data());
  if (surely_of_triangle(p, {a, b, a})) return true;
  if (is_surely_far(p, a, b, distance_)) return false;
  const ExactVector d = difference(b, a), w = difference(p, a);
  const Dyadic along = dot(w, d), dd = dot(d, d);
  if (along.sign() <= 0) return dot(w, w) <= square_;
  if (along >= dd) return of_point(p, b);
  return dot(w, w) * dd - along * along <= square_ * dd;
}

bool Reach::of_triangle(const Point& p, const std::array<Point, 3>& t) const {
  if (p == t[0] || p == t[1] || p == t[2]) return true;
  if (distance_ == 0) return on_triangle(p.data(), {t[0].data(), t[1].data(), t[2].data()});
  if (surely_of_triangle(p, t)) return true;
  if (is_surely_far(p, t, distance_)) return false;
  const ExactVector n = cross(difference(t[1], t[0]), difference(t[2], t[0]));
  bool above = dot(n, n).sign() > 0;
  for (std::size_t i = 0; above && i < 3; ++i) {
    const Point &a = t[i], &b = t[(i + 1) % 3];
    above = dot(cross(difference(b, a), difference(p, a)), n).sign() >= 0;
  }
  if (above) {
    const Dyadic height = dot(difference(p, t[0]), n);
    return height * height <= square_ * dot(n, n);
  }
  return of_segment(p, t[0], t[1]) || of_segment(p, t[1], t[2]) || of_segment(p, t[2], t[0]);
}

/// Often the distance is as small as rounding itself; then only the longer format, if there is one, can
/// decide.
bool Reach::surely_of_triangle(const Point& p, const std::array<Point, 3>& t) const {
  return is_surely_near<double>(p, t, distance_) || is_surely_near<long double>(p, t, distance_);
}

int compare_distance(const Point& p, const Point& q, double distance) {
  const ExactVector d = difference(p, q);
  const auto order = dot(d, d) <=> Dyadic(distance) * Dyadic(distance);
  return std::is_lt(order) ? -1 : std::is_gt(order) ? 1 : 0;
}

/// With the area A and the sides a, b, c the radius is 2 A / (a + b + c). Lengths are rounded up, so a radius
/// that exceeds the distance by only a few units in the last place counts as at most the distance.
bool inscribed_at_most(const std::array<Point, 3>& t, double distance) {
  const ExactVector n = cross(difference(t[1], t[0]), difference(t[2], t[0]));
  const double sides =
      (rough_distance(t[0], t[1]) + rough_distance(t[1], t[2]) + rough_distance(t[2], t[0])) * (1 + 0x1p-48);
  if (!std::isfinite(sides)) return false;
  const Dyadic bound = Dyadic(distance) * Dyadic(sides);
  return dot(n, n) <= bound * bound;
}

double rough_distance(const Point& p, const Point& q) { return length(minus<double>(p, q)); }

double rough_distance(const Point& p, const std::array<Point, 3>& t) {
  double scale = 0;
  return residual(p, t, scale);
}

}  // namespace holdfast::checking
