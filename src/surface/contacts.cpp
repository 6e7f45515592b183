// Surface layer: pairs of faces of two simplices that meet, and where.
#include "surface/contacts.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include "exact/dyadic.h"
#include "surface/signs.h"

namespace holdfast {
namespace {

using exact::Dyadic;

// Corners of the face with mask m.
constexpr std::array<std::array<unsigned, 3>, 8> kCorners = {
    {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {0, 2, 0}, {1, 2, 0}, {0, 1, 2}}};
constexpr std::array<unsigned, 8> kCount = {0, 1, 1, 2, 1, 2, 2, 3};

// --- Certificates -----------------------------------------------------------------------------------

// Corners of a simplex as a mask, narrowed down to those that the common part can depend on.
struct Narrowed {
  const Simplex& simplex;
  unsigned mask;

  // Keeps the corners whose coordinate k is `value`.
  void keep(unsigned k, double value) {
    for (unsigned i = 0; i < simplex.corners; ++i) {
      if (simplex.point[i][k] != value) mask &= ~(1u << i);
    }
  }
  // Least and greatest coordinate k.
  [[nodiscard]] std::pair<double, double> range(unsigned k) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (unsigned i = 0; i < simplex.corners; ++i) {
      if ((mask >> i & 1u) == 0) continue;
      low = std::min(low, simplex.point[i][k]);
      high = std::max(high, simplex.point[i][k]);
    }
    return {low, high};
  }
  // Whether each of its corners is one of the other's.
  [[nodiscard]] bool is_face_of(const Narrowed& other) const {
    for (unsigned i = 0; i < simplex.corners; ++i) {
      bool found = (mask >> i & 1u) == 0;
      for (unsigned j = 0; j < other.simplex.corners; ++j) {
        found = found || ((other.mask >> j & 1u) != 0 && other.simplex.vertex[j] == simplex.vertex[i]);
      }
      if (!found) return false;
    }
    return true;
  }
};

// Comparisons of coordinates alone. Where two boxes only touch, at x_k = c, the simplices meet in the common
// part of their faces in this plane, and another coordinate may tell these apart: the normal case in
// grids and in parts that are parallel to the axes, where the signs below are mostly zero.
bool coordinates_separate(const Simplex& a, const Simplex& b) {
  Narrowed m{a, (1u << a.corners) - 1}, n{b, (1u << b.corners) - 1};
  for (unsigned k = 0, settled = 0; settled < 3; k = (k + 1) % 3) {
    const auto [low_m, high_m] = m.range(k);
    const auto [low_n, high_n] = n.range(k);
    if (high_m < low_n || high_n < low_m) return true;
    ++settled;
    const bool flat = low_m == high_m && low_n == high_n;
    if (flat || (high_m != low_n && high_n != low_m)) continue;
    const double value = high_m == low_n ? high_m : low_m;
    m.keep(k, value);
    n.keep(k, value);
    settled = 0;
  }
  return m.is_face_of(n) || n.is_face_of(m);
}

// The signs as the filters give them, where 0 means "not known", or as they are. Certificates that rest on
// strict signs hold with both, and most pairs need no sign that is zero.
struct Filtered {
  static constexpr bool kZeroIsKnown = false;
  static int turn(const double* a, const double* b, const double* c, unsigned axis) {
    const unsigned x = (axis + 1) % 3, y = (axis + 2) % 3;
    return exact::detail::orient2d_filter(a[x], a[y], b[x], b[y], c[x], c[y]);
  }
  static int volume(const double* a, const double* b, const double* c, const double* d) {
    return exact::detail::orient3d_filter(a, b, c, d);
  }
};
struct Exact {
  static constexpr bool kZeroIsKnown = true;
  static int turn(const double* a, const double* b, const double* c, unsigned axis) {
    return turn_of(a, b, c, axis);
  }
  static int volume(const double* a, const double* b, const double* c, const double* d) {
    return exact::orient3d(a, b, c, d);
  }
};

// Two facets that share `Shared::count` corners.
struct Shared {
  unsigned count = 0;
  std::array<unsigned, 3> mine{}, theirs{};  // t's corners, and u's in the same order
};

Shared shared_corners(const Simplex& t, const Simplex& u) {
  Shared shared;
  for (unsigned i = 0; i < 3; ++i) {
    for (unsigned j = 0; j < 3; ++j) {
      if (t.vertex[i] == u.vertex[j]) {
        shared.mine[shared.count] = i;
        shared.theirs[shared.count++] = j;
      }
    }
  }
  return shared;
}

template <class Signs>
struct Certificates {
  // Whether `p`, projected along t's axis, lies strictly beyond side i of `t`.
  static bool beyond(const Simplex& t, unsigned i, const double* p) {
    return t.turn * Signs::turn(t.point[i], t.point[(i + 1) % 3], p, t.axis) < 0;
  }
  static int side(const Simplex& t, const double* p) {
    return Signs::volume(t.point[0], t.point[1], t.point[2], p);
  }
  static Sides sides(const Simplex& t, const Simplex& u) {
    return {side(t, u.point[0]), side(t, u.point[1]), side(t, u.point[2])};
  }
  static bool one_strict_side(const Sides& s) { return s[0] != 0 && s[0] == s[1] && s[0] == s[2]; }

  // In the projection of `t`, all of `u` lies strictly beyond one side.
  static bool projection_separates(const Simplex& t, const Simplex& u) {
    for (unsigned i = 0; i < 3; ++i) {
      if (beyond(t, i, u.point[0]) && beyond(t, i, u.point[1]) && beyond(t, i, u.point[2])) return true;
    }
    return false;
  }

  static bool apart(const Simplex& t, const Simplex& u) {
    if (projection_separates(t, u) || projection_separates(u, t)) return true;
    const Sides sides_u = sides(t, u);
    if (one_strict_side(sides_u)) return true;
    const Sides sides_t = sides(u, t);
    if (one_strict_side(sides_t)) return true;
    const auto known = [](const Sides& s) { return s[0] * s[1] * s[2] != 0; };
    if (!Signs::kZeroIsKnown && !(known(sides_t) && known(sides_u))) return false;
    // The closed intervals that the facets cut out of the common line are disjoint (LineOrder).
    const unsigned i = lone_corner(sides_t), j = lone_corner(sides_u);
    if (i == 3 || j == 3) return false;
    const auto order = [&](unsigned m, unsigned n) {
      return Signs::volume(t.point[i], t.point[(i + m) % 3], u.point[j], u.point[(j + n) % 3]);
    };
    const int sign = order(1, 1);
    return sign != 0 && order(2, 2) == sign && order(1, 2) == sign && order(2, 1) == sign;
  }

  // In the projection of `t`, all of `u` but its corner j lies strictly beyond a side through corner i.
  static bool projection_separates_at(const Simplex& t, unsigned i, const Simplex& u, unsigned j) {
    const double* p = u.point[(j + 1) % 3];
    const double* q = u.point[(j + 2) % 3];
    const unsigned before = (i + 2) % 3;
    return (beyond(t, i, p) && beyond(t, i, q)) || (beyond(t, before, p) && beyond(t, before, q));
  }

  // Corner i of `t` is corner j of `u`.
  static bool fit_at_vertex(const Simplex& t, unsigned i, const Simplex& u, unsigned j) {
    if (projection_separates_at(t, i, u, j) || projection_separates_at(u, j, t, i)) return true;
    const unsigned u1 = (j + 1) % 3, u2 = (j + 2) % 3, t1 = (i + 1) % 3, t2 = (i + 2) % 3;
    const int side_u = side(t, u.point[u1]) * side(t, u.point[u2]);
    if (side_u > 0) return true;
    const int side_t = side(u, t.point[t1]) * side(u, t.point[t2]);
    if (side_t > 0) return true;
    if (side_u == 0 || side_t == 0) return false;
    // Each cuts an interval out of the common line that ends at the vertex v. They leave it in opposite
    // directions if v - p and q - v have one sign, p and q being the other ends (LineOrder).
    const int v_minus_p = Signs::volume(t.point[t1], t.point[t2], u.point[u1], u.point[j]);
    return v_minus_p != 0 && v_minus_p == Signs::volume(t.point[t1], t.point[i], u.point[u1], u.point[u2]);
  }

  // All corners but i of `t` and j of `u` are the same.
  static bool fit_at_side(const Simplex& t, unsigned i, const Simplex& u, unsigned j) {
    if (beyond(t, (i + 1) % 3, u.point[j]) || beyond(u, (j + 1) % 3, t.point[i])) return true;
    return side(t, u.point[j]) != 0;
  }

  static bool fit(const Simplex& t, const Simplex& u, const Shared& shared) {
    const auto &mine = shared.mine, &theirs = shared.theirs;
    switch (shared.count) {
      case 0:
        return apart(t, u);
      case 1:
        return fit_at_vertex(t, mine[0], u, theirs[0]);
      case 2:
        return fit_at_side(t, 3 - mine[0] - mine[1], u, 3 - theirs[0] - theirs[1]);
      default:
        return false;
    }
  }
};

// --- All pairs of faces -----------------------------------------------------------------------------

// Sides of the plane of `t`, if it is a facet, of the corners of the other simplex.
Sides sides_of_corners(const Simplex& t, const Simplex& other) {
  Sides sides{0, 0, 0};
  if (t.corners == 3) {
    for (unsigned i = 0; i < other.corners; ++i) sides[i] = side_of(t, other.point[i]);
  }
  return sides;
}

bool same_face(const Simplex& a, unsigned mask_a, const Simplex& b, unsigned mask_b) {
  if (kCount[mask_a] != kCount[mask_b]) return false;
  for (unsigned i = 0; i < kCount[mask_a]; ++i) {
    bool found = false;
    for (unsigned j = 0; j < kCount[mask_b]; ++j) {
      found = found || a.vertex[kCorners[mask_a][i]] == b.vertex[kCorners[mask_b][j]];
    }
    if (!found) return false;
  }
  return true;
}

// Interiors of different faces; the face of `a` has no more corners than that of `b`.
Meet faces_meet(const Simplex& a, unsigned mask_a, const Sides& sides_a, const Simplex& b, unsigned mask_b,
                const Sides& sides_b) {
  const auto& i = kCorners[mask_a];
  const auto& j = kCorners[mask_b];
  const double* const p = a.point[i[0]];
  if (kCount[mask_b] == 1) return Meet::none;  // different vertices are different points
  if (kCount[mask_a] == 1) {
    const bool in =
        kCount[mask_b] == 2 ? in_segment(p, b.point[j[0]], b.point[j[1]]) : in_facet(p, sides_a[i[0]], b);
    return in ? Meet::point : Meet::none;
  }
  if (kCount[mask_b] == 2) return segments_meet(p, a.point[i[1]], b.point[j[0]], b.point[j[1]]);
  if (kCount[mask_a] == 2) return segment_meets_facet(p, sides_a[i[0]], a.point[i[1]], sides_a[i[1]], b);
  return facets_meet(a, sides_a, b, sides_b);
}

// Calls visit(mask of a, mask of b, same face?, how they meet) for all pairs of faces that meet.
template <class Visit>
void for_each_contact(const Simplex& a, const Simplex& b, Visit&& visit) {
  const Sides sides_a = sides_of_corners(b, a), sides_b = sides_of_corners(a, b);
  for (unsigned mask_a = 1; mask_a < 1u << a.corners; ++mask_a) {
    for (unsigned mask_b = 1; mask_b < 1u << b.corners; ++mask_b) {
      if (same_face(a, mask_a, b, mask_b)) {
        visit(mask_a, mask_b, true, static_cast<Meet>(kCount[mask_a]));
        continue;
      }
      const Meet meet = kCount[mask_a] <= kCount[mask_b] ? faces_meet(a, mask_a, sides_a, b, mask_b, sides_b)
                                                         : faces_meet(b, mask_b, sides_b, a, mask_a, sides_a);
      if (meet != Meet::none) visit(mask_a, mask_b, false, meet);
    }
  }
}

// --- Places -----------------------------------------------------------------------------------------

Point point_of(const double* p) { return {p[0], p[1], p[2]}; }

// The quotient, rounded from the rounded exact terms; the scaling keeps them off the ends of the range.
double quotient(const Dyadic& numerator, const Dyadic& denominator) {
  const std::int64_t shift = -(denominator.exponent() + static_cast<std::int64_t>(denominator.bits()));
  return numerator.scaled(shift).to_double() / denominator.scaled(shift).to_double();
}

// The point of ab where the affine function with values at_a and at_b, of opposite signs, is zero.
Point zero_between(const double* a, const Dyadic& at_a, const double* b, const Dyadic& at_b) {
  const Dyadic difference = at_a - at_b;
  Point point;
  for (unsigned k = 0; k < 3; ++k) {
    const double value = quotient(at_a * Dyadic(b[k]) - at_b * Dyadic(a[k]), difference);
    point[k] = std::clamp(value, std::min(a[k], b[k]), std::max(a[k], b[k])) + 0.0;  // no -0
  }
  return point;
}

Dyadic minus(double a, double b) { return Dyadic(a) - Dyadic(b); }

// Component `axis` of (b - a) x (c - a).
Dyadic area(const double* a, const double* b, const double* c, unsigned axis) {
  const unsigned x = (axis + 1) % 3, y = (axis + 2) % 3;
  return minus(b[x], a[x]) * minus(c[y], a[y]) - minus(b[y], a[y]) * minus(c[x], a[x]);
}

Point crossing(const double* a, const double* b, const double* c, const double* d) {
  for (unsigned axis = 0;; ++axis) {
    const Dyadic at_a = area(c, d, a, axis), at_b = area(c, d, b, axis);
    if (axis == 2 || at_a.sign() != at_b.sign()) return zero_between(a, at_a, b, at_b);
  }
}

Point piercing(const double* a, const double* b, const Simplex& t) {
  const double* const o = t.point[0];
  const Dyadic normal[3] = {area(o, t.point[1], t.point[2], 0), area(o, t.point[1], t.point[2], 1),
                            area(o, t.point[1], t.point[2], 2)};
  const auto height = [&](const double* p) {
    return normal[0] * minus(p[0], o[0]) + normal[1] * minus(p[1], o[1]) + normal[2] * minus(p[2], o[2]);
  };
  return zero_between(a, height(a), b, height(b));
}

}  // namespace

bool surely_fit(const Simplex& a, const Simplex& b) {
  if (a.corners != 3 || b.corners != 3) return false;
  const Shared shared = shared_corners(a, b);
  if (shared.count == 3) return false;
  return Certificates<Filtered>::fit(a, b, shared) || coordinates_separate(a, b) ||
         Certificates<Exact>::fit(a, b, shared);
}

Contacts contacts(const Simplex& a, const Simplex& b) {
  Contacts found;
  for_each_contact(a, b, [&found](unsigned mask_a, unsigned mask_b, bool same, Meet) {
    (same ? found.common : found.distinct) |= Contacts::bit(mask_a, mask_b);
  });
  return found;
}

Common common_part(const Simplex& a, const Simplex& b) {
  Common found;
  for_each_contact(a, b, [&found](unsigned mask_a, unsigned mask_b, bool, Meet meet) {
    found.is_area = found.is_area || meet == Meet::area;
    if (meet != Meet::point) return;
    if (found.count < found.touches.size()) found.touches[found.count] = {mask_a, mask_b};
    ++found.count;
  });
  if (found.is_area) found.count = 0;
  return found;
}

std::vector<Point> common_corners(const Simplex& a, const Simplex& b) {
  std::vector<Point> corners;
  for_each_contact(a, b, [&](unsigned mask_a, unsigned mask_b, bool, Meet meet) {
    if (meet != Meet::point) return;
    const auto& i = kCorners[mask_a];
    const auto& j = kCorners[mask_b];
    if (kCount[mask_a] == 1) {
      corners.push_back(point_of(a.point[i[0]]));
    } else if (kCount[mask_b] == 1) {
      corners.push_back(point_of(b.point[j[0]]));
    } else if (kCount[mask_a] == 3) {
      corners.push_back(piercing(b.point[j[0]], b.point[j[1]], a));
    } else if (kCount[mask_b] == 3) {
      corners.push_back(piercing(a.point[i[0]], a.point[i[1]], b));
    } else {
      corners.push_back(crossing(a.point[i[0]], a.point[i[1]], b.point[j[0]], b.point[j[1]]));
    }
  });
  return corners;
}

}  // namespace holdfast
