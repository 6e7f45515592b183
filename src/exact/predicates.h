// Orientation and in-sphere predicates: exact signs, decided by the cheapest tier that can.
//
// Tiers: a floating-point filter (inline, here), then exact arithmetic (predicates.cpp). Coordinates
// must be finite; any finite magnitude is answered rightly, denormals and overflow included.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "exact/point.h"

namespace holdfast::exact {

namespace detail {

/// 2^-53: the relative error of one rounding.
inline constexpr double kEpsilon = 0x1p-53;

[[nodiscard]] int orient3d_slow(const double* a, const double* b, const double* c, const double* d);
[[nodiscard]] int orient3d_mixed_filter(const double* a, const double* b, const double* c, const double* d);
[[nodiscard]] int orient2d_mixed_filter(const double* a, const double* b, const double* c, int x, int y);
[[nodiscard]] int orient3d_mixed(PointRef a, PointRef b, PointRef c, PointRef d);
[[nodiscard]] int orient2d_slow(const double* a, const double* b, const double* c);
[[nodiscard]] int insphere_slow(const double* a, const double* b, const double* c, const double* d,
                                const double* e);

/// The sign of a value that errs by at most `bound`, or 0. One branch that is taken nearly always: two,
/// on det > bound and -det > bound, are mispredicted half of the time.
[[nodiscard]] inline int filtered_sign(double value, double bound) {
  if (std::fabs(value) > bound) return value > 0 ? 1 : -1;
  return 0;
}

/// Decides orient3d in floating point: +1 or -1, or 0 where it cannot tell.
///
/// Error bound: (7 + 56 eps) eps times the permanent (Shewchuk 1997, section 4.3). Besides, each of the
/// six products of differences may underflow and then errs by up to 2^-1075, magnified by its factor z,
/// and so may the three products with z: 2^-1073 (1 + heights). The bound takes 2^-900 instead, since
/// denormals cost a hundred cycles. An overflow makes the bound infinite or NaN, and no comparison with
/// it holds.
[[nodiscard]] inline int orient3d_filter(const double* a, const double* b, const double* c, const double* d) {
  const double bx = b[0] - a[0], by = b[1] - a[1], bz = b[2] - a[2];
  const double cx = c[0] - a[0], cy = c[1] - a[1], cz = c[2] - a[2];
  const double dx = d[0] - a[0], dy = d[1] - a[1], dz = d[2] - a[2];
  const double cxdy = cx * dy, dxcy = dx * cy;
  const double dxby = dx * by, bxdy = bx * dy;
  const double bxcy = bx * cy, cxby = cx * by;
  const double det = bz * (cxdy - dxcy) + cz * (dxby - bxdy) + dz * (bxcy - cxby);
  const double permanent = (std::fabs(cxdy) + std::fabs(dxcy)) * std::fabs(bz) +
                           (std::fabs(dxby) + std::fabs(bxdy)) * std::fabs(cz) +
                           (std::fabs(bxcy) + std::fabs(cxby)) * std::fabs(dz);
  const double heights = std::fabs(bz) + std::fabs(cz) + std::fabs(dz);
  const double bound = (7 + 64 * kEpsilon) * kEpsilon * permanent + (0x1p-900 + 0x1p-900 * heights);
  return filtered_sign(det, bound);
}

/// Decides orient2d in floating point: +1 or -1, or 0 where it cannot tell.
/// Error bound: (3 + 16 eps) eps (Shewchuk 1997, section 4.2) plus the underflow of two products.
[[nodiscard]] inline int orient2d_filter(double ax, double ay, double bx, double by, double cx, double cy) {
  const double left = (ax - cx) * (by - cy);
  const double right = (ay - cy) * (bx - cx);
  const double det = left - right;
  const double bound = (3 + 16 * kEpsilon) * kEpsilon * (std::fabs(left) + std::fabs(right)) + 0x1p-900;
  return filtered_sign(det, bound);
}

/// Decides insphere in floating point: +1 or -1, or 0 where it cannot tell.
///
/// Every term passes 16 roundings, so the error is at most (16 + O(eps)) eps P, with P the sum of the
/// absolute values of all terms. Let r_i be the norms of the four differences and S the sum of their
/// squares. The permanent of three rows is at most sqrt(2) times the product of their norms (expand
/// along one row; Cauchy-Schwarz twice), so P <= sqrt(2) r1 r2 r3 r4 (r1 + r2 + r3 + r4), which is at
/// most sqrt(2) (S/4)^2 2 sqrt(S) < 0.1768 S^2.5. Hence 3 eps S^2.5 bounds the error and leaves 5 %
/// for the rounding of the bound itself. Underflow: with |det| > 2^-700, S > 2^-290, and all
/// underflowing roundings together err by less than 2^-1000 (1 + S^1.5). Overflow: P is less than
/// S^2.5, so the bound overflows first.
[[nodiscard]] inline int insphere_filter(const double* a, const double* b, const double* c, const double* d,
                                         const double* e) {
  const double ax = a[0] - e[0], ay = a[1] - e[1], az = a[2] - e[2];
  const double bx = b[0] - e[0], by = b[1] - e[1], bz = b[2] - e[2];
  const double cx = c[0] - e[0], cy = c[1] - e[1], cz = c[2] - e[2];
  const double dx = d[0] - e[0], dy = d[1] - e[1], dz = d[2] - e[2];
  const double ab = ax * by - bx * ay, bc = bx * cy - cx * by;
  const double cd = cx * dy - dx * cy, da = dx * ay - ax * dy;
  const double ac = ax * cy - cx * ay, bd = bx * dy - dx * by;
  const double abc = az * bc - bz * ac + cz * ab;
  const double bcd = bz * cd - cz * bd + dz * bc;
  const double cda = cz * da + dz * ac + az * cd;
  const double dab = dz * ab + az * bd + bz * da;
  const double a2 = ax * ax + ay * ay + az * az;
  const double b2 = bx * bx + by * by + bz * bz;
  const double c2 = cx * cx + cy * cy + cz * cz;
  const double d2 = dx * dx + dy * dy + dz * dz;
  const double det = (c2 * dab - d2 * abc) + (a2 * bcd - b2 * cda);
  const double s = (a2 + b2) + (c2 + d2);
  const double bound = 3 * kEpsilon * (s * s * std::sqrt(s)) + 0x1p-700;
  return filtered_sign(det, bound);
}

}  // namespace detail

/// Sign of det(b - a, c - a, d - a): +1 where abcd is a positive tetrahedron, 0 where the four points
/// are coplanar, -1 else.
///
/// Laws: (1) swapping two arguments negates; (2) an even permutation changes nothing; (3) translating
/// all points by an amount that every coordinate takes exactly, or scaling by a power of two, changes
/// nothing; (4) a repeated point gives 0; (5) a = 0, b = x, c = y, d = z gives +1.
[[nodiscard]] inline int orient3d(const double* a, const double* b, const double* c, const double* d) {
  const int sign = detail::orient3d_filter(a, b, c, d);
  return sign != 0 ? sign : detail::orient3d_slow(a, b, c, d);
}

/// orient3d(a, b, c, d) in floating point for many d, as orient3d_filter decides it: what abc alone say is
/// computed once.
class OrientFilter {
 public:
  OrientFilter(const double* a, const double* b, const double* c) : a_{a[0], a[1], a[2]} {
    const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const double yz = uy * vz, zy = uz * vy, zx = uz * vx, xz = ux * vz, xy = ux * vy, yx = uy * vx;
    normal_ = {yz - zy, zx - xz, xy - yx};
    permanent_ = {std::fabs(yz) + std::fabs(zy), std::fabs(zx) + std::fabs(xz),
                  std::fabs(xy) + std::fabs(yx)};
  }
  /// +1 or -1, or 0 where it cannot tell.
  [[nodiscard]] int operator()(const double* d) const {
    const Estimate e = estimate(d[0], d[1], d[2]);
    return detail::filtered_sign(e.determinant, e.bound);
  }

 private:
  struct Estimate {
    double determinant, bound;
  };
  // The bound is that of orient3d_filter: the determinant's rows have become its columns.
  [[nodiscard]] Estimate estimate(double dx, double dy, double dz) const {
    const double x = dx - a_[0], y = dy - a_[1], z = dz - a_[2];
    const double ax = std::fabs(x), ay = std::fabs(y), az = std::fabs(z);
    const double permanent = ax * permanent_[0] + ay * permanent_[1] + az * permanent_[2];
    return {
        x * normal_[0] + y * normal_[1] + z * normal_[2],
        (7 + 64 * detail::kEpsilon) * detail::kEpsilon * permanent + (0x1p-900 + 0x1p-900 * (ax + ay + az))};
  }

  std::array<double, 3> a_, normal_, permanent_;
};

/// The same for points that may be exact. Law (6): equals the double version where both apply.
[[nodiscard]] inline int orient3d(PointRef a, PointRef b, PointRef c, PointRef d) {
  if (a.exact == nullptr && b.exact == nullptr && c.exact == nullptr && d.exact == nullptr) [[likely]] {
    return orient3d(a.approx, b.approx, c.approx, d.approx);
  }
  return detail::orient3d_mixed(a, b, c, d);
}

/// Sign of det(b - a, c - a) for points of the plane: +1 where abc turns left.
///
/// Laws: (1) swapping two arguments negates; (2) translation and scaling by powers of two, where exact,
/// change nothing; (3) a repeated point gives 0; (4) a = 0, b = x, c = y gives +1.
[[nodiscard]] inline int orient2d(const double* a, const double* b, const double* c) {
  const int sign = detail::orient2d_filter(a[0], a[1], b[0], b[1], c[0], c[1]);
  return sign != 0 ? sign : detail::orient2d_slow(a, b, c);
}

/// orient2d of the projections along coordinate `axis`: the plane's first coordinate is (axis + 1) % 3,
/// its second (axis + 2) % 3. It is the sign of component `axis` of the normal (b - a) x (c - a).
[[nodiscard]] int orient2d(PointRef a, PointRef b, PointRef c, int axis);

/// +1 where e lies strictly inside the circumsphere of the positive tetrahedron abcd, 0 on it, -1
/// outside.
///
/// Laws: (1) swapping two of a, b, c, d negates, so that a negative tetrahedron gives the opposite
/// sign; (2) swapping e with one of them negates too (the five points lift to a 4-simplex on the
/// paraboloid); (3) translation and scaling by powers of two, where exact, change nothing; (4) a
/// repeated point gives 0; (5) the centre of a positive tetrahedron's sphere gives +1.
[[nodiscard]] inline int insphere(const double* a, const double* b, const double* c, const double* d,
                                  const double* e) {
  const int sign = detail::insphere_filter(a, b, c, d, e);
  return sign != 0 ? sign : detail::insphere_slow(a, b, c, d, e);
}

}  // namespace holdfast::exact
