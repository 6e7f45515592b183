// What the Delaunay kernel keeps of a tetrahedron: one cache line with its corners, its neighbours and
// its circumscribed sphere, so that most in-sphere tests read one line and one corner.
//
// The sphere. Corner 0 is the base p. With u, v, w the other corners relative to p, the sphere is
// { d : |d|^2 - m.d = 0 } in coordinates relative to p, where
//     m = N / D,  N = |u|^2 (v x w) + |v|^2 (w x u) + |w|^2 (u x v),  D = u.(v x w) > 0,
// that is, m is twice the centre. A point at d lies strictly inside iff f(d) = |d|^2 - m.d < 0.
// A ghost tetrahedron (p a b ghost) is the half-space beyond its hull face: m = u x v and f(d) = -m.d.
//
// Error bound of f (e = 2^-53; all differences, products and sums relative to the exact coordinates).
// The components of a computed cross product are off by at most 4 e times the sum of the absolute
// products, the vector by 4 sqrt(2) e |v||w| < 6 e |v||w|. Hence
//     |dN| <= 3 (6 + 6) e |u||v||w| R + 2 * 3 e |u||v||w| R = 42 e |u||v||w| R,  R = max(|u|, |v|, |w|),
//     |dD| <= (6 + 4) e |u||v||w|.
// Let s = e |u||v||w| / D, which is at least e. A chord is no longer than the diameter: R <= |m|. So
//     |dm| <= (42 R + 10 |m|) s + 2 e |m| <= 55 s |m|   (to first order; s <= 2^-20 is required), and
//     |df| <= 5 e |d|^2 + (55 s + 4 e) |m||d| + e |f|.
// If |d| <= 1.5 |m|, |df| <= 68 s |m||d| + e |f|. Else f >= |d|^2 / 3 is too large to come out negative.
// The sign of f is thus right wherever f^2 > reach |d|^2 with reach = (128 s |m|)^2: the rest of the
// factor covers rounding in reach itself and in the comparison.
// For a ghost |df| <= (6 + 4) e |u||v||d|, and reach = (16 e |u||v|)^2.
// Underflow: reach is infinite, so that the test decides nothing, unless D^2 >= 2^-600 and
// |u||v||w| <= 2^300, |m| <= 2^200; then D >= 2^-300, R >= 2^-100 and the bounds above exceed 2^-460,
// while products below the normal range contribute at most 2^-1074 * 2^400. In the test itself the
// same is met by the term 2^-960. An overflow in |d|^2 makes the comparison false.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "mesh/anatomy.h"

namespace holdfast {

struct alignas(64) Cell {
  std::array<Vertex, 4> v;
  std::array<Face, 4> n;
  std::array<double, 3> m;
  double reach;  ///< of the filter; negative: in the cavity, or a free slot
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

/// The sphere of (p, p+u, p+v, p+w), a positive tetrahedron.
inline void set_sphere(Cell& cell, const Spoke& u, const Spoke& v, const Spoke& w) {
  const double vwx = v.y * w.z - v.z * w.y, vwy = v.z * w.x - v.x * w.z, vwz = v.x * w.y - v.y * w.x;
  const double wux = w.y * u.z - w.z * u.y, wuy = w.z * u.x - w.x * u.z, wuz = w.x * u.y - w.y * u.x;
  const double uvx = u.y * v.z - u.z * v.y, uvy = u.z * v.x - u.x * v.z, uvz = u.x * v.y - u.y * v.x;
  const double d = u.x * vwx + u.y * vwy + u.z * vwz;
  const double inverse = 1 / d;
  const double mx = (u.w * vwx + v.w * wux + w.w * uvx) * inverse;
  const double my = (u.w * vwy + v.w * wuy + w.w * uvy) * inverse;
  const double mz = (u.w * vwz + v.w * wuz + w.w * uvz) * inverse;
  const double mm = mx * mx + my * my + mz * mz;
  const double product = u.w * v.w * w.w;
  const double ratio = product * (inverse * inverse);  // (s / e)^2
  const bool ok =
      (d >= 0x1p-300) & (product <= 0x1p600) & (ratio >= 0.5) & (ratio <= 0x1p66) & (mm <= 0x1p400);
  cell.m = {mx, my, mz};
  cell.reach = ok ? 0x1p-92 * ratio * mm : kUndecided;
}

/// The half-space beyond the hull face (p, p+u, p+v).
inline void set_half_space(Cell& cell, const Spoke& u, const Spoke& v) {
  cell.m = {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  const double product = u.w * v.w;
  const bool ok = (product >= 0x1p-600) & (product <= 0x1p600);
  cell.reach = ok ? 0x1p-98 * product : kUndecided;
}

/// +1 if q is strictly inside the cell's sphere or half-space, -1 if strictly outside, 0 if the filter
/// cannot tell. `base` is the position of corner 0; `lift` is 1, or 0 for a ghost.
[[nodiscard]] inline int filtered_conflict(const Cell& cell, double lift, const double* base,
                                           const double* q) {
  const double x = q[0] - base[0], y = q[1] - base[1], z = q[2] - base[2];
  const double dd = x * x + y * y + z * z;
  const double f = lift * dd - (cell.m[0] * x + cell.m[1] * y + cell.m[2] * z);
  if (f * f > cell.reach * dd + 0x1p-960) [[likely]]
    return f < 0 ? 1 : -1;
  return 0;
}

}  // namespace holdfast
