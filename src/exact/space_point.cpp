// Points of space with rational coordinates.
#include "exact/space_point.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "exact/determinant.h"
#include "numbers/float_environment.h"

namespace holdfast::exact {
namespace {

/// Divides by the largest power of two that divides all of them.
void reduce(std::array<BigInt*, 4> numbers) {
  std::size_t zeros = std::numeric_limits<std::size_t>::max();
  for (const BigInt* n : numbers)
    if (!n->is_zero()) zeros = std::min(zeros, trailing_zeros(*n));
  if (zeros == 0 || zeros == std::numeric_limits<std::size_t>::max()) return;
  for (BigInt* n : numbers)
    if (!n->is_zero()) *n >>= zeros;  // rounding to minus infinity does no harm: only zeros are shifted out
}

/// Several points on one grid: integers in units of 2^-exponent; the exponent is 0 if they are integers
/// anyway.
template <std::size_t N>
struct OnGrid {
  std::array<Row<BigInt>, N> points;
  std::size_t shift = 0;  ///< their unit is 2^-shift
};

template <std::size_t N>
OnGrid<N> on_grid(const std::array<const double*, N>& points) {
  std::array<std::array<Dyadic, 3>, N> exact;
  std::int64_t low = 0;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      exact[i][k] = Dyadic(points[i][k]);
      if (exact[i][k].sign() != 0) low = std::min(low, exact[i][k].exponent());
    }
  OnGrid<N> grid;
  grid.shift = static_cast<std::size_t>(-low);
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (exact[i][k].sign() != 0)
        grid.points[i][k] = exact[i][k].mantissa() << static_cast<std::size_t>(exact[i][k].exponent() - low);
  return grid;
}

Row<BigInt> minus(const Row<BigInt>& p, const Row<BigInt>& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}
BigInt dot(const Row<BigInt>& u, const Row<BigInt>& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }
Row<BigInt> normal_of(const SpacePlane& p) { return {p.a, p.b, p.c}; }

SpacePlane plane_of(const Row<BigInt>& normal, const Row<BigInt>& point, std::size_t shift) {
  SpacePlane plane{normal[0] << shift, normal[1] << shift, normal[2] << shift, -dot(normal, point)};
  reduce({&plane.a, &plane.b, &plane.c, &plane.d});
  return plane;
}

SpacePoint with_positive_weight(SpacePoint p) {
  if (p.w.sign() < 0) p = {-p.x, -p.y, -p.z, -p.w};
  reduce({&p.x, &p.y, &p.z, &p.w});
  return p;
}

}  // namespace

SpacePoint space_point(const double* p) {
  const OnGrid<1> grid = on_grid<1>({p});
  const Row<BigInt>& x = grid.points[0];
  return {x[0], x[1], x[2], BigInt(1) << grid.shift};
}

SpacePlane plane_through(const double* p, const double* q, const double* r) {
  const OnGrid<3> grid = on_grid<3>({p, q, r});
  const auto& [a, b, c] = grid.points;
  return plane_of(cross(minus(b, a), minus(c, a)), a, grid.shift);
}

SpacePlane upright_plane(const double* p, const double* q, unsigned axis) {
  const OnGrid<2> grid = on_grid<2>({p, q});
  const Row<BigInt> d = minus(grid.points[1], grid.points[0]);
  Row<BigInt> normal;
  normal[(axis + 1) % 3] = -d[(axis + 2) % 3];
  normal[(axis + 2) % 3] = d[(axis + 1) % 3];
  return plane_of(normal, grid.points[0], grid.shift);
}

/// Let s_p and s_q be the sides of p and q: then p s_q - q s_p has side 0.
SpacePoint crossing(const double* p, const double* q, const SpacePlane& plane) {
  const OnGrid<2> grid = on_grid<2>({p, q});
  const auto& [a, b] = grid.points;
  const Row<BigInt> normal = normal_of(plane);
  const BigInt weighted = plane.d << grid.shift;
  const BigInt at_a = dot(normal, a) + weighted, at_b = dot(normal, b) + weighted;
  return with_positive_weight({a[0] * at_b - b[0] * at_a, a[1] * at_b - b[1] * at_a,
                               a[2] * at_b - b[2] * at_a, (at_b - at_a) << grid.shift});
}

/// Cramer's rule.
SpacePoint crossing(const SpacePlane& p, const SpacePlane& q, const SpacePlane& r) {
  const Row<BigInt> u = normal_of(p), v = normal_of(q), w = normal_of(r);
  const Row<BigInt> vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
  const auto along = [&](std::size_t k) -> BigInt { return p.d * vw[k] + q.d * wu[k] + r.d * uv[k]; };
  return with_positive_weight({-along(0), -along(1), -along(2), dot(u, vw)});
}

std::array<double, 3> nearest(const SpacePoint& p) {
  return {nearest_quotient(p.x, p.w) + 0.0, nearest_quotient(p.y, p.w) + 0.0,
          nearest_quotient(p.z, p.w) + 0.0};
}

RationalPoint projected(const SpacePoint& p, unsigned axis) {
  switch (axis) {
    case 0:
      return {p.y, p.z, p.w};
    case 1:
      return {p.z, p.x, p.w};
    default:
      return {p.x, p.y, p.w};
  }
}

bool equal(const SpacePoint& p, const SpacePoint& q) {
  return p.x * q.w == q.x * p.w && p.y * q.w == q.y * p.w && p.z * q.w == q.z * p.w;
}

int compare(const SpacePoint& p, const SpacePoint& q) {
  for (const auto coordinate : {&SpacePoint::x, &SpacePoint::y, &SpacePoint::z})
    if (const int sign = BigInt(p.*coordinate * q.w - q.*coordinate * p.w).sign(); sign != 0) return sign;
  return 0;
}

double distance_bound(const SpacePoint& p, const double* q) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const SpacePoint other = space_point(q);
  std::array<double, 3> apart{};
  double most = 0;
  const std::array<std::array<const BigInt*, 2>, 3> coordinates{
      {{&p.x, &other.x}, {&p.y, &other.y}, {&p.z, &other.z}}};
  const BigInt weight = p.w * other.w;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [mine, theirs] = coordinates[k];
    const BigInt difference = abs(BigInt(*mine * other.w - *theirs * p.w));
    if (difference.is_zero()) continue;
    apart[k] = std::nextafter(nearest_quotient(difference, weight), kInfinity);
    most = std::max(most, apart[k]);
  }
  if (most == 0 || most == kInfinity) return most;
  double sum = 0;
  for (const double a : apart) sum += (a / most) * (a / most);
  // Four roundings, each within half a unit, and one of the product.
  return std::nextafter(most * (std::sqrt(sum) * (1 + 0x1p-50)), kInfinity);
}

}  // namespace holdfast::exact
