// Surface layer: the signs from which the tests of two simplices are built. Private to the layer.
#pragma once

#include <algorithm>
#include <array>

#include "exact/predicates.h"
#include "surface/intersect.h"

namespace holdfast {

/// The sides of a plane or line on which the three corners of a facet lie: each +1, 0 or -1.
using Sides = std::array<int, 3>;

/// Sign of the area of abc in the projection along `axis`.
inline int turn_of(const double* a, const double* b, const double* c, unsigned axis) {
  const unsigned x = (axis + 1) % 3, y = (axis + 2) % 3;
  const double pa[2] = {a[x], a[y]};
  const double pb[2] = {b[x], b[y]};
  const double pc[2] = {c[x], c[y]};
  return exact::orient2d(pa, pb, pc);
}

/// The side of the plane of facet `t` on which `p` lies.
inline int side_of(const Simplex& t, const double* p) {
  return exact::orient3d(t.point[0], t.point[1], t.point[2], p);
}

/// The sides of the plane of `t` on which the corners of `u` lie.
inline Sides sides_of(const Simplex& t, const Simplex& u) {
  return {side_of(t, u.point[0]), side_of(t, u.point[1]), side_of(t, u.point[2])};
}

/// +1 if `p`, projected along t's axis, lies inside side i of `t` (from corner i to i + 1), 0 on its line, -1
/// beyond.
inline int inside_of(const Simplex& t, unsigned i, const double* p) {
  return t.turn * turn_of(t.point[i], t.point[(i + 1) % 3], p, t.axis);
}

inline bool both_signs(const Sides& s) {
  return (s[0] < 0 || s[1] < 0 || s[2] < 0) && (s[0] > 0 || s[1] > 0 || s[2] > 0);
}

/// A corner strictly on one side with the others on the opposite closed side; 3 if there is none.
inline unsigned lone_corner(const Sides& s) {
  for (unsigned i = 0; i < 3; ++i) {
    if (s[i] != 0 && s[(i + 1) % 3] * s[i] <= 0 && s[(i + 2) % 3] * s[i] <= 0) return i;
  }
  return 3;
}

/// Order of points of two facets on the common line L of their planes. Let i be a lone corner of `t`, and j
/// one of `u`. Then L cuts t in [p1, p2] with p_m on the side from corner i to i + m, and u in [q1, q2]
/// likewise. The result is the sign of q_n - p_m along L, up to a factor of +-1 that is the same for all
/// m and n. (With t_i, u_j, L fixed, the determinant is linear in the position of p_m, and of q_n, on L;
/// and the lines t_i p_m and u_j q_n are in one plane only where they meet, which they do on L.)
struct LineOrder {
  const Simplex& t;
  const Simplex& u;
  unsigned i, j;

  [[nodiscard]] int operator()(unsigned m, unsigned n) const {
    return exact::orient3d(t.point[i], t.point[(i + m) % 3], u.point[j], u.point[(j + n) % 3]);
  }
};

}  // namespace holdfast
