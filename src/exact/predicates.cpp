// The exact tiers of the predicates.
#include "exact/predicates.h"

#include <array>

namespace holdfast::exact {
namespace {

using Vector = std::array<Dyadic, 3>;

Vector minus(const ExactPoint& a, const ExactPoint& b) {
  return {a.c[0] - b.c[0], a.c[1] - b.c[1], a.c[2] - b.c[2]};
}

Dyadic det(const Vector& u, const Vector& v, const Vector& w) {
  return u[2] * (v[0] * w[1] - w[0] * v[1]) + v[2] * (w[0] * u[1] - u[0] * w[1]) +
         w[2] * (u[0] * v[1] - v[0] * u[1]);
}

Dyadic square(const Vector& u) { return u[0] * u[0] + u[1] * u[1] + u[2] * u[2]; }

int orient3d_exact(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, const ExactPoint& d) {
  return det(minus(b, a), minus(c, a), minus(d, a)).sign();
}

Dyadic coordinate(PointRef p, int i) {
  return p.exact != nullptr ? p.exact->c[static_cast<std::size_t>(i)] : Dyadic(p.approx[i]);
}

int orient2d_exact(const Dyadic& ax, const Dyadic& ay, const Dyadic& bx, const Dyadic& by, const Dyadic& cx,
                   const Dyadic& cy) {
  return ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)).sign();
}

}  // namespace

namespace detail {

int orient3d_slow(const double* a, const double* b, const double* c, const double* d) {
  return orient3d_exact(lift(a), lift(b), lift(c), lift(d));
}

int orient3d_mixed(PointRef a, PointRef b, PointRef c, PointRef d) {
  return orient3d_exact(lift(a), lift(b), lift(c), lift(d));
}

int orient2d_slow(const double* a, const double* b, const double* c) {
  return orient2d_exact(a[0], a[1], b[0], b[1], c[0], c[1]);
}

int insphere_slow(const double* a, const double* b, const double* c, const double* d, const double* e) {
  const ExactPoint origin = lift(e);
  const Vector u = minus(lift(a), origin), v = minus(lift(b), origin);
  const Vector w = minus(lift(c), origin), x = minus(lift(d), origin);
  const Dyadic left = square(u) * det(v, w, x) - square(v) * det(w, x, u);
  const Dyadic right = square(w) * det(x, u, v) - square(x) * det(u, v, w);
  return (left + right).sign();
}

}  // namespace detail

int orient2d(PointRef a, PointRef b, PointRef c, int axis) {
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  if (a.exact == nullptr && b.exact == nullptr && c.exact == nullptr) {
    const double pa[2] = {a.approx[x], a.approx[y]};
    const double pb[2] = {b.approx[x], b.approx[y]};
    const double pc[2] = {c.approx[x], c.approx[y]};
    return orient2d(pa, pb, pc);
  }
  return orient2d_exact(coordinate(a, x), coordinate(a, y), coordinate(b, x), coordinate(b, y),
                        coordinate(c, x), coordinate(c, y));
}

}  // namespace holdfast::exact
