// Surface layer: exact tests of the interiors of two simplices.
#include "surface/intersect.h"

#include <cmath>
#include <utility>

#include "surface/signs.h"

namespace holdfast {
namespace {

bool less(const double* a, const double* b) { return std::lexicographical_compare(a, a + 3, b, b + 3); }

bool collinear(const double* a, const double* b, const double* c) {
  return turn_of(a, b, c, 0) == 0 && turn_of(a, b, c, 1) == 0 && turn_of(a, b, c, 2) == 0;
}

// Whether the closed bounding boxes of two point sets are disjoint.
template <std::size_t M, std::size_t N>
bool boxes_apart(const std::array<const double*, M>& p, const std::array<const double*, N>& q) {
  for (unsigned k = 0; k < 3; ++k) {
    double low_p = p[0][k], high_p = p[0][k], low_q = q[0][k], high_q = q[0][k];
    for (const double* x : p) {
      low_p = std::min(low_p, x[k]);
      high_p = std::max(high_p, x[k]);
    }
    for (const double* x : q) {
      low_q = std::min(low_q, x[k]);
      high_q = std::max(high_q, x[k]);
    }
    if (high_p < low_q || high_q < low_p) return true;
  }
  return false;
}

// Whether the open intervals (p1, p2) and (q1, q2) on the common line overlap: not all q are after all p,
// ends included, nor before.
bool open_intervals_overlap(const LineOrder& order) {
  bool before = false, behind = false;
  for (unsigned m = 1; m <= 2; ++m) {
    for (unsigned n = 1; n <= 2; ++n) {
      const int sign = order(m, n);
      before = before || sign < 0;
      behind = behind || sign > 0;
      if (before && behind) return true;
    }
  }
  return false;
}

// Whether the line along a side of `t` separates the facets, which are both in the plane of `t`.
bool side_separates(const Simplex& t, const Simplex& u) {
  for (unsigned i = 0; i < 3; ++i) {
    if (inside_of(t, i, u.point[0]) <= 0 && inside_of(t, i, u.point[1]) <= 0 &&
        inside_of(t, i, u.point[2]) <= 0)
      return true;
  }
  return false;
}

bool coplanar_facets_overlap(const Simplex& t, const Simplex& u) {
  return !side_separates(t, u) && !side_separates(u, t);
}

// Whether the interiors of ab and `t`, both in one plane, meet: neither the line of a side nor the line ab
// separates them.
bool coplanar_segment_overlaps(const double* a, const double* b, const Simplex& t) {
  for (unsigned i = 0; i < 3; ++i) {
    if (inside_of(t, i, a) <= 0 && inside_of(t, i, b) <= 0) return false;
  }
  return both_signs({turn_of(a, b, t.point[0], t.axis), turn_of(a, b, t.point[1], t.axis),
                     turn_of(a, b, t.point[2], t.axis)});
}

}  // namespace

bool set_projection(Simplex& t) {
  // Tries the longest component of the normal first: a guess that mostly saves the other two.
  double u[3], v[3], n[3];
  for (unsigned k = 0; k < 3; ++k) {
    u[k] = t.point[1][k] - t.point[0][k];
    v[k] = t.point[2][k] - t.point[0][k];
  }
  for (unsigned k = 0; k < 3; ++k) {
    n[k] = std::fabs(u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
  }
  const unsigned longest = n[0] > n[1] ? (n[0] > n[2] ? 0 : 2) : (n[1] > n[2] ? 1 : 2);
  for (unsigned k = 0; k < 3; ++k) {
    t.axis = (longest + k) % 3;
    t.turn = turn_of(t.point[0], t.point[1], t.point[2], t.axis);
    if (t.turn != 0) return true;
  }
  return false;
}

bool in_segment(const double* p, const double* a, const double* b) {
  if (boxes_apart<1, 2>({p}, {a, b})) return false;
  if (less(b, a)) std::swap(a, b);
  return less(a, p) && less(p, b) && collinear(a, b, p);
}

bool in_facet(const double* p, int side_p, const Simplex& t) {
  return side_p == 0 && inside_of(t, 0, p) > 0 && inside_of(t, 1, p) > 0 && inside_of(t, 2, p) > 0;
}

bool in_facet(const double* p, const Simplex& t) {
  return !boxes_apart<1, 3>({p}, t.point) && in_facet(p, side_of(t, p), t);
}

Meet segments_meet(const double* a, const double* b, const double* c, const double* d) {
  if (boxes_apart<2, 2>({a, b}, {c, d})) return Meet::none;
  if (exact::orient3d(a, b, c, d) != 0) return Meet::none;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const int of_c = turn_of(a, b, c, axis), of_d = turn_of(a, b, d, axis);
    if (of_c == 0 && of_d == 0) continue;  // collinear, or the projection flattens the plane
    const bool cross = of_c * of_d < 0 && turn_of(c, d, a, axis) * turn_of(c, d, b, axis) < 0;
    return cross ? Meet::point : Meet::none;
  }
  if (less(b, a)) std::swap(a, b);
  if (less(d, c)) std::swap(c, d);
  return less(a, d) && less(c, b) ? Meet::length : Meet::none;
}

Meet segment_meets_facet(const double* a, int side_a, const double* b, int side_b, const Simplex& t) {
  if (side_a == 0 && side_b == 0) return coplanar_segment_overlaps(a, b, t) ? Meet::length : Meet::none;
  if (side_a * side_b >= 0) return Meet::none;
  // Whether the line ab passes all three sides of t in the same direction.
  const int way = exact::orient3d(a, b, t.point[0], t.point[1]);
  if (way == 0 || exact::orient3d(a, b, t.point[1], t.point[2]) != way) return Meet::none;
  return exact::orient3d(a, b, t.point[2], t.point[0]) == way ? Meet::point : Meet::none;
}

Meet segment_meets_facet(const double* a, const double* b, const Simplex& t) {
  if (boxes_apart<2, 3>({a, b}, t.point)) return Meet::none;
  return segment_meets_facet(a, side_of(t, a), b, side_of(t, b), t);
}

Meet facets_meet(const Simplex& t, const Sides& sides_t, const Simplex& u, const Sides& sides_u) {
  if (sides_t == Sides{0, 0, 0}) return coplanar_facets_overlap(t, u) ? Meet::area : Meet::none;
  if (!both_signs(sides_t) || !both_signs(sides_u)) return Meet::none;
  const LineOrder order{t, u, lone_corner(sides_t), lone_corner(sides_u)};
  return open_intervals_overlap(order) ? Meet::length : Meet::none;
}

Meet facets_meet(const Simplex& t, const Simplex& u) {
  if (boxes_apart<3, 3>(t.point, u.point)) return Meet::none;
  return facets_meet(t, sides_of(u, t), u, sides_of(t, u));
}

}  // namespace holdfast
