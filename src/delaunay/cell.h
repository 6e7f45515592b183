// A tetrahedron in the Delaunay kernel: one cache line with its corners, its neighbours and
// its circumscribed sphere, so that most in-sphere tests read one line and one corner.
//
// The sphere. Corner 0 is the base p. With u, v, w the other corners relative to p, the sphere is
// { d : |d|^2 - m.d = 0 } in coordinates relative to p, where
//     m = N / D,  N = |u|^2 (v x w) + |v|^2 (w x u) + |w|^2 (u x v),  D = u.(v x w) > 0,
// that is, m is twice the centre. A point at d lies strictly inside iff f(d) = |d|^2 - m.d < 0.
//
// Error bound of f (e = 2^-53; all differences, products and sums relative to the exact coordinates).
// The components of a computed cross product are off by at most 4 e times the sum of the absolute
// products, the vector by 4 sqrt(2) e |v||w| < 6 e |v||w|. N is computed as
// |u|^2 (v x w) + u x (|w|^2 v - |v|^2 w). Hence
//     |dN| <= (6 + 6) e |u|^2 |v||w| + (12 + 7) e |u| (|w|^2 |v| + |v|^2 |w|) + ... <= 54 e |u||v||w| R,
//     |dD| <= (6 + 4) e |u||v||w|,   where R = max(|u|, |v|, |w|).
// Let s = e |u||v||w| / D, which is at least e. A chord is no longer than the diameter: R <= |m|. So
//     |dm| <= (54 R + 10 |m|) s + 2 e |m| <= 67 s |m|   (to first order; s <= 2^-20 is required), and
//     |df| <= 5 e |d|^2 + (67 s + 4 e) |m||d| + e |f|.
// If |d| <= 1.5 |m|, |df| <= 79 s |m||d| + e |f|. Else f >= |d|^2 / 3 is too large to come out negative.
// The sign of f is thus right wherever f^2 > reach |d|^2 with reach = (128 s |m|)^2: the rest of the
// factor covers rounding in reach itself and in the comparison.
//
// A ghost (p a b ghost) is the half-space beyond its hull face, n.d > 0 with n = u x v. It is kept as a
// huge sphere, m = t n with t = L / (16 e |u||v|) and L the diameter of the point set. Then |d|^2 <= L |d|
// counts as an error like that of m.d, which is at most (6 + 6) e |u||v| t |d| = 0.75 L |d|; reach = (2 L)^2.
//
// Underflow and overflow: reach is infinite, so that the test decides nothing, unless D >= 2^-200,
// s <= 2^33 e and |m| <= 2^100. Then R <= 2^100, and no length is below 2^-400, so that |u||v||w| is
// right and the bounds above exceed 2^(-53-200-100), while a product below the normal range errs by at
// most 2^-1074 times 2^300. In the test itself the same is met by the term 2^-960; an overflow makes
// the comparison false.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "mesh/anatomy.h"
#include "numbers/pair.h"

namespace holdfast {

struct alignas(64) Cell {
  std::array<Vertex, 4> v;
  std::array<Face, 4> n;
  std::array<double, 3> m;
  double reach;  ///< of the filter; with its sign bit set: in the cavity, or a free slot
};
static_assert(sizeof(Cell) == 64);

/// A vertex relative to the base: difference and squared length.
struct Spoke {
  double x, y, z, w;
};

inline constexpr double kUndecided = std::numeric_limits<double>::infinity();

[[nodiscard]] inline Spoke spoke(const double* p, const double* q) {
  const double x = q[0] - p[0], y = q[1] - p[1], z = q[2] - p[2];
  return {x, y, z, x * x + y * y + z * z};
}

/// The spheres of two positive tetrahedra (p, p+u, p+v, p+w) at once.
inline void set_spheres(std::array<Cell*, 2> cells, std::array<const Spoke*, 2> u,
                        std::array<const Spoke*, 2> v, std::array<const Spoke*, 2> w) {
  const Pair ux = {u[0]->x, u[1]->x}, uy = {u[0]->y, u[1]->y}, uz = {u[0]->z, u[1]->z};
  const Pair vx = {v[0]->x, v[1]->x}, vy = {v[0]->y, v[1]->y}, vz = {v[0]->z, v[1]->z};
  const Pair wx = {w[0]->x, w[1]->x}, wy = {w[0]->y, w[1]->y}, wz = {w[0]->z, w[1]->z};
  const Pair uu = {u[0]->w, u[1]->w}, vv = {v[0]->w, v[1]->w}, ww = {w[0]->w, w[1]->w};
  const Pair cx = vy * wz - vz * wy, cy = vz * wx - vx * wz, cz = vx * wy - vy * wx;
  const Pair tx = ww * vx - vv * wx, ty = ww * vy - vv * wy, tz = ww * vz - vv * wz;
  const Pair d = ux * cx + uy * cy + uz * cz;
  const Pair inverse = 1 / d;
  const Pair mx = (uu * cx + (uy * tz - uz * ty)) * inverse;
  const Pair my = (uu * cy + (uz * tx - ux * tz)) * inverse;
  const Pair mz = (uu * cz + (ux * ty - uy * tx)) * inverse;
  const Pair mm = mx * mx + my * my + mz * mz;
  const Pair ratio = uu * vv * ww * (inverse * inverse);  // (s / e)^2
  const Pair undecided = {kUndecided, kUndecided};
  const auto ok = (d >= 0x1p-200) & (ratio <= 0x1p66) & (mm <= 0x1p200);
  const Pair reach = ok ? 0x1p-92 * ratio * mm : undecided;
  cells[0]->m = {mx[0], my[0], mz[0]};
  cells[0]->reach = reach[0];
  cells[1]->m = {mx[1], my[1], mz[1]};
  cells[1]->reach = reach[1];
}

/// The half-space beyond the hull face (p, p+u, p+v) of points at most `diameter` apart.
inline void set_half_space(Cell& cell, const Spoke& u, const Spoke& v, double diameter) {
  const double product = u.w * v.w;
  const double scale = diameter / (0x1p-49 * std::sqrt(product));
  const bool ok =
      (product >= 0x1p-400) & (product <= 0x1p400) & (diameter >= 0x1p-200) & (diameter <= 0x1p200);
  cell.m = {(u.y * v.z - u.z * v.y) * scale, (u.z * v.x - u.x * v.z) * scale,
            (u.x * v.y - u.y * v.x) * scale};
  cell.reach = ok ? 4 * diameter * diameter : kUndecided;
}

/// The filter's answer for a point: `f` is negative if the point is strictly inside the cell's sphere or
/// half-space, positive if strictly outside, unless the filter cannot decide.
struct Filtered {
  double f;
  bool decided;
};

/// `base` is the position of corner 0.
[[nodiscard]] inline Filtered filtered_conflict(const Cell& cell, const double* base, double qx, double qy,
                                                double qz) {
  const double x = qx - base[0], y = qy - base[1], z = qz - base[2];
  const double dd = x * x + y * y + z * z;
  const double f = dd - (cell.m[0] * x + cell.m[1] * y + cell.m[2] * z);
  return {f, f * f > cell.reach * dd + 0x1p-960};
}

}  // namespace holdfast
