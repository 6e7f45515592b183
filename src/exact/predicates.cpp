// The predicates beyond their inline filters: the filter for exact points and the order of the tiers.
#include "exact/predicates.h"

#include "exact/incircle.h"
#include "exact/tiers.h"
#include "numbers/float_environment.h"

namespace holdfast::exact {
namespace detail {
namespace {

// Each compiles to one instruction; references (std::max) may become branches.
double larger(double a, double b) { return a < b ? b : a; }
double smaller(double a, double b) { return b < a ? b : a; }

}  // namespace

/// Decides orient3d of exact points from their approximations, or 0.
///
/// Along each axis i let M be the largest coordinate and D the largest computed difference. Coordinates
/// err by eps M, so differences by 2 eps M and eps D for their rounding: x_i D with x_i = eps (2 M / D
/// + 1). The determinant has six terms of three differences, hence it errs by 6 Dx Dy Dz times
/// (1 + x_0) (1 + x_1) (1 + x_2) - 1 <= exp(x) - 1, x the sum of the x_i, which is at most 1.35 x while
/// x <= 0.5. That holds wherever the filter decides: then 6 * 1.35 x Dx Dy Dz <= |det| <= 4 Dx Dy Dz
/// (Hadamard). So 16.2 eps (Mx Dy Dz + ...) + 24.3 eps Dx Dy Dz bounds this part, and the other four
/// roundings of every term add 24 eps Dx Dy Dz. With every D above 2^-300, underflow is far below that.
int orient3d_mixed_filter(const double* a, const double* b, const double* c, const double* d) {
  double m[3], extent[3], u[3], v[3], w[3];
  for (int i = 0; i < 3; ++i) {
    u[i] = b[i] - a[i];
    v[i] = c[i] - a[i];
    w[i] = d[i] - a[i];
    m[i] = larger(larger(std::fabs(a[i]), std::fabs(b[i])), larger(std::fabs(c[i]), std::fabs(d[i])));
    extent[i] = larger(larger(std::fabs(u[i]), std::fabs(v[i])), std::fabs(w[i]));
  }
  if (!(smaller(smaller(extent[0], extent[1]), extent[2]) > 0x1p-300)) return 0;
  const double det = u[2] * (v[0] * w[1] - w[0] * v[1]) + v[2] * (w[0] * u[1] - u[0] * w[1]) +
                     w[2] * (u[0] * v[1] - v[0] * u[1]);
  const double xy = extent[0] * extent[1];
  const double from_coordinates = xy * m[2] + (extent[0] * m[1] + m[0] * extent[1]) * extent[2];
  const double bound = kEpsilon * (16.5 * from_coordinates + 49 * (xy * extent[2]));
  return filtered_sign(det, bound);
}

/// The same in the plane: two terms of two differences err by 2 Dx Dy times (1 + x_0) (1 + x_1) - 1, at
/// most 1.25 x while x <= 0.8, which holds since |det| <= 2 Dx Dy; two more roundings a term.
int orient2d_mixed_filter(const double* a, const double* b, const double* c, int x, int y) {
  const double ux = b[x] - a[x], uy = b[y] - a[y];
  const double vx = c[x] - a[x], vy = c[y] - a[y];
  const double mx = larger(larger(std::fabs(a[x]), std::fabs(b[x])), std::fabs(c[x]));
  const double my = larger(larger(std::fabs(a[y]), std::fabs(b[y])), std::fabs(c[y]));
  const double dx = larger(std::fabs(ux), std::fabs(vx));
  const double dy = larger(std::fabs(uy), std::fabs(vy));
  if (!(smaller(dx, dy) > 0x1p-300)) return 0;
  const double det = ux * vy - uy * vx;
  const double bound = kEpsilon * (5.1 * (mx * dy + dx * my) + 9.5 * (dx * dy));
  return filtered_sign(det, bound);
}

Decision decide_orient3d(const double* a, const double* b, const double* c, const double* d) {
  if (const auto sign = integer_orient3d<1>(a, b, c, d)) return {*sign, Tier::integer64};
  if (const auto sign = integer_orient3d<2>(a, b, c, d)) return {*sign, Tier::integer128};
  if (const auto sign = expansion_orient3d(a, b, c, d)) return {*sign, Tier::expansion};
  return {big_orient3d({a}, {b}, {c}, {d}), Tier::big_integer};
}

Decision decide_orient2d(const double* a, const double* b, const double* c) {
  if (const auto sign = integer_orient2d<1>(a, b, c)) return {*sign, Tier::integer64};
  if (const auto sign = integer_orient2d<2>(a, b, c)) return {*sign, Tier::integer128};
  if (const auto sign = expansion_orient2d(a, b, c)) return {*sign, Tier::expansion};
  // The third coordinate only satisfies the interface.
  const double pa[3] = {a[0], a[1], 0}, pb[3] = {b[0], b[1], 0}, pc[3] = {c[0], c[1], 0};
  return {big_orient2d({pa}, {pb}, {pc}, 2), Tier::big_integer};
}

Decision decide_insphere(const double* a, const double* b, const double* c, const double* d,
                         const double* e) {
  if (const auto sign = integer_insphere<1>(a, b, c, d, e)) return {*sign, Tier::integer64};
  if (const auto sign = integer_insphere<2>(a, b, c, d, e)) return {*sign, Tier::integer128};
  if (const auto sign = expansion_insphere(a, b, c, d, e)) return {*sign, Tier::expansion};
  return {big_insphere(a, b, c, d, e), Tier::big_integer};
}

Decision decide_incircle(const double* a, const double* b, const double* c, const double* d) {
  if (const auto sign = integer_incircle<1>(a, b, c, d)) return {*sign, Tier::integer64};
  if (const auto sign = integer_incircle<2>(a, b, c, d)) return {*sign, Tier::integer128};
  return {big_incircle(a, b, c, d), Tier::big_integer};
}

int orient3d_slow(const double* a, const double* b, const double* c, const double* d) {
  // Boxes have many points in one plane across an axis.
  for (std::size_t k = 0; k < 3; ++k)
    if (a[k] == b[k] && a[k] == c[k] && a[k] == d[k]) return 0;
  return decide_orient3d(a, b, c, d).sign;
}

int orient3d_mixed(PointRef a, PointRef b, PointRef c, PointRef d) {
  const int sign = orient3d_mixed_filter(a.approx, b.approx, c.approx, d.approx);
  return sign != 0 ? sign : decide_orient3d(a, b, c, d).sign;
}

int orient2d_slow(const double* a, const double* b, const double* c) {
  // Grids and drawings have many points along an axis, and sweeps ask about ends of segments.
  const bool ab[] = {a[0] == b[0], a[1] == b[1]}, bc[] = {b[0] == c[0], b[1] == c[1]};
  if ((ab[0] && bc[0]) || (ab[1] && bc[1]) || (ab[0] && ab[1]) || (bc[0] && bc[1])) return 0;
  if (a[0] == c[0] && a[1] == c[1]) return 0;
  return decide_orient2d(a, b, c).sign;
}

int insphere_slow(const double* a, const double* b, const double* c, const double* d, const double* e) {
  return decide_insphere(a, b, c, d, e).sign;
}

int incircle_slow(const double* a, const double* b, const double* c, const double* d) {
  return decide_incircle(a, b, c, d).sign;
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
  const int sign = detail::orient2d_mixed_filter(a.approx, b.approx, c.approx, x, y);
  return sign != 0 ? sign : detail::decide_orient2d(a, b, c, axis).sign;
}

}  // namespace holdfast::exact
