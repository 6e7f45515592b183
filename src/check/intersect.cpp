// Check: exact tests of how points, segments and triangles meet.
//
// Two triangles meet in a convex set. If they share a vertex v and the set holds another point p, the
// ray from v through p leaves one of the triangles, still inside the other, on the side opposite v:
// that side then meets the other triangle. If they share nothing, a side of one meets the other. So all
// reduces to a closed segment against a closed triangle that have no vertex in common.
#include "check/intersect.h"

#include <algorithm>

#include "exact/predicates.h"

namespace holdfast::checking {

using exact::orient3d;

int orient_along(std::size_t axis, const double* a, const double* b, const double* c) {
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  const std::array<double, 2> pa{a[u], a[v]};
  const std::array<double, 2> pb{b[u], b[v]};
  const std::array<double, 2> pc{c[u], c[v]};
  return exact::orient2d(pa.data(), pb.data(), pc.data());
}

namespace {

/// A coordinate axis along which a triangle's projection keeps area, and the sign of that area (0: it has
/// none).
struct Projection {
  std::size_t axis;
  int sign;
};

Projection projection(const Corners& t) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (const int sign = orient_along(axis, t[0], t[1], t[2]); sign != 0) return {axis, sign};
  return {0, 0};
}

/// Whether p, in the plane of the triangle, lies on it.
bool inside(const double* p, const Corners& t, const Projection& along) {
  for (std::size_t i = 0; i < 3; ++i)
    if (orient_along(along.axis, t[i], t[(i + 1) % 3], p) == -along.sign) return false;
  return true;
}

bool between(double low, double x, double high) {
  return std::min(low, high) <= x && x <= std::max(low, high);
}

/// Whether two segments of one plane meet; along `axis` the plane's projection keeps areas.
bool segments_meet(const double* p, const double* q, const double* a, const double* b, std::size_t axis) {
  const int pq_a = orient_along(axis, p, q, a);
  const int pq_b = orient_along(axis, p, q, b);
  const int ab_p = orient_along(axis, a, b, p);
  const int ab_q = orient_along(axis, a, b, q);
  if (pq_a * pq_b < 0 && ab_p * ab_q < 0) return true;
  const auto touches = [&](int sign, const double* x, const double* s, const double* e) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    return sign == 0 && between(s[u], x[u], e[u]) && between(s[v], x[v], e[v]);
  };
  return touches(pq_a, a, p, q) || touches(pq_b, b, p, q) || touches(ab_p, p, a, b) || touches(ab_q, q, a, b);
}

/// Whether the closed segment pq meets the closed triangle, given the sides of the triangle's plane on which
/// p and q lie. They have no vertex in common.
bool segment_meets(const double* p, const double* q, int side_p, int side_q, const Corners& t) {
  if (side_p * side_q > 0) return false;
  if (side_p != 0 && side_q != 0) {
    const int s0 = orient3d(p, q, t[0], t[1]);
    const int s1 = orient3d(p, q, t[1], t[2]);
    if (s0 * s1 < 0) return false;
    const int s2 = orient3d(p, q, t[2], t[0]);
    return s0 * s2 >= 0 && s1 * s2 >= 0;
  }
  const Projection along = projection(t);
  if (side_p == 0 && inside(p, t, along)) return true;
  if (side_q == 0 && inside(q, t, along)) return true;
  if (side_p != 0 || side_q != 0) return false;
  for (std::size_t i = 0; i < 3; ++i)
    if (segments_meet(p, q, t[i], t[(i + 1) % 3], along.axis)) return true;
  return false;
}

/// Whether, in the triangle's plane, the direction from its corner i to w points into the closed corner.
bool points_into_corner(const double* w, const Corners& t, std::size_t i) {
  const Projection along = projection(t);
  const double* v = t[i];
  return orient_along(along.axis, v, t[(i + 1) % 3], w) != -along.sign &&
         orient_along(along.axis, v, w, t[(i + 2) % 3]) != -along.sign;
}

/// The corners of x and y, shared ones first.
struct Shared {
  std::size_t count = 0;
  std::array<std::size_t, 3> in_x{}, in_y{};  ///< positions: shared ones in the same order, then the rest
};

Shared match(const Triangle& x, const Triangle& y) {
  Shared shared;
  std::array<bool, 3> used{};
  std::size_t rest = 2;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto j = static_cast<std::size_t>(std::find(y.begin(), y.end(), x[i]) - y.begin());
    if (j == 3) {
      shared.in_x[rest--] = i;
    } else {
      shared.in_x[shared.count] = i;
      shared.in_y[shared.count++] = j;
      used[j] = true;
    }
  }
  rest = 2;
  for (std::size_t j = 0; j < 3; ++j)
    if (!used[j]) shared.in_y[rest--] = j;
  return shared;
}

int side_of_plane(const Corners& t, const double* p) { return orient3d(t[0], t[1], t[2], p); }

/// Two triangles with the common side ab and the third corners c and d.
bool hinge_meets(const double* a, const double* b, const double* c, const double* d) {
  if (orient3d(a, b, c, d) != 0) return false;
  const Projection along = projection({a, b, c});
  return orient_along(along.axis, a, b, d) == along.sign;
}

/// Whether the boxes of a segment and a triangle are disjoint. In a large fan or a book of many pages they
/// mostly are, while the boxes of any two triangles overlap at its centre or spine.
bool far_apart(const double* p, const double* q, const Corners& t) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
    if (std::max(p[axis], q[axis]) < low || std::min(p[axis], q[axis]) > high) return true;
  }
  return false;
}

/// Two triangles with a common first corner: whether the opposite side of t meets s.
bool opposite_side_meets(const Corners& s, const Corners& t) {
  if (far_apart(t[1], t[2], s)) return false;
  return segment_meets(t[1], t[2], side_of_plane(s, t[1]), side_of_plane(s, t[2]), s);
}

/// Two triangles without a common vertex.
bool sides_meet(const Corners& s, const Corners& t) {
  std::array<bool, 3> far_s{}, far_t{};
  bool all_far = true;
  for (std::size_t i = 0; i < 3; ++i) {
    far_t[i] = far_apart(t[i], t[(i + 1) % 3], s);
    far_s[i] = far_apart(s[i], s[(i + 1) % 3], t);
    all_far = all_far && far_t[i] && far_s[i];
  }
  if (all_far) return false;
  const auto sides = [](const Corners& plane, const Corners& of) {
    return std::array{side_of_plane(plane, of[0]), side_of_plane(plane, of[1]), side_of_plane(plane, of[2])};
  };
  const auto one_side = [](const std::array<int, 3>& side) {
    return side[0] != 0 && side[0] == side[1] && side[1] == side[2];
  };
  const std::array<int, 3> side_t = sides(s, t);
  if (one_side(side_t)) return false;
  const std::array<int, 3> side_s = sides(t, s);
  if (one_side(side_s)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (!far_t[i] && segment_meets(t[i], t[j], side_t[i], side_t[j], s)) return true;
    if (!far_s[i] && segment_meets(s[i], s[j], side_s[i], side_s[j], t)) return true;
  }
  return false;
}

}  // namespace

bool collinear(const double* a, const double* b, const double* c) { return projection({a, b, c}).sign == 0; }

bool on_segment(const double* p, const double* a, const double* b) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!between(a[axis], p[axis], b[axis])) return false;
  return collinear(p, a, b);
}

bool on_triangle(const double* p, const Corners& t) {
  if (side_of_plane(t, p) != 0) return false;
  const Projection along = projection(t);
  if (along.sign != 0) return inside(p, t, along);
  return on_segment(p, t[0], t[1]) || on_segment(p, t[1], t[2]) || on_segment(p, t[2], t[0]);
}

bool meet_badly(const Triangle& x, const Corners& x_corners, const Triangle& y, const Corners& y_corners) {
  const Shared shared = match(x, y);
  Corners s, t;
  for (std::size_t i = 0; i < 3; ++i) {
    s[i] = x_corners[shared.in_x[i]];
    t[i] = y_corners[shared.in_y[i]];
  }
  if (shared.count == 2) return hinge_meets(s[0], s[1], s[2], t[2]);
  if (shared.count == 1) return opposite_side_meets(s, t) || opposite_side_meets(t, s);
  return sides_meet(s, t);
}

bool meet_badly(const Segment& segment, const double* p, const double* q, const Triangle& triangle,
                const Corners& corners) {
  const auto at_p =
      static_cast<std::size_t>(std::find(triangle.begin(), triangle.end(), segment[0]) - triangle.begin());
  const auto at_q =
      static_cast<std::size_t>(std::find(triangle.begin(), triangle.end(), segment[1]) - triangle.begin());
  if (at_p < 3 && at_q < 3) return false;
  const int side_p = at_p < 3 ? 0 : side_of_plane(corners, p);
  const int side_q = at_q < 3 ? 0 : side_of_plane(corners, q);
  if (at_p < 3) return side_q == 0 && points_into_corner(q, corners, at_p);
  if (at_q < 3) return side_p == 0 && points_into_corner(p, corners, at_q);
  return segment_meets(p, q, side_p, side_q, corners);
}

}  // namespace holdfast::checking
