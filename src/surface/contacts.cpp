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
// The corner at which the face begins so that its corners follow each other counterclockwise: side i leads
// from corner i to the next one.
constexpr std::array<unsigned, 8> kBegin = {0, 0, 1, 0, 2, 2, 1, 0};

// --- Certificates

// Corners of a simplex as a mask, narrowed down to those on which the common part can depend.
struct Narrowed {
  const Simplex& simplex;
  unsigned mask;

  // Keeps the corners whose coordinate k is `value`.
  void keep(unsigned k, double value) {
    for (unsigned i = 0; i < simplex.corners; ++i) {
      if (simplex.point[i][k] != value) mask &= ~(1u << i);
    }
  }
  // The least and the greatest coordinate k.
  [[nodiscard]] std::pair<double, double> range(unsigned k) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (unsigned i = 0; i < simplex.corners; ++i) {
      if ((mask >> i & 1u) == 0) continue;
      low = std::min(low, simplex.point[i][k]);
      high = std::max(high, simplex.point[i][k]);
    }
    return {low, high};
  }
  // Whether each of its corners is also a corner of the other.
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

// Comparisons of coordinates alone. If two boxes only touch, at x_k = c, the simplices meet in the common
// part of their faces in this plane, and another coordinate may separate these. That is the normal case in
// grids and in parts parallel to the axes, where the signs below are mostly zero.
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

// The signs, either from the filters, where 0 means "not known", or exact. Certificates that need strict
// signs hold with both, and most pairs need no sign that is zero.
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
    // Each facet cuts an interval out of the common line that ends at the vertex v. The intervals leave v in
    // opposite directions if v - p and q - v have one sign, where p and q are the other ends (LineOrder).
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

// --- All pairs of faces

// Sides of the plane of `t`, if it is a facet, on which the corners of the other simplex lie.
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

// The faces of a simplex whose interiors may meet a plane, bit m for mask m: faces with corners on both sides
// of the plane, or with all corners on it.
unsigned faces_at_plane(const Sides& sides, unsigned corners) {
  unsigned faces = 0;
  for (unsigned mask = 1; mask < 1u << corners; ++mask) {
    bool above = false, below = false;
    for (unsigned i = 0; i < corners; ++i) {
      if ((mask >> i & 1u) == 0) continue;
      above = above || sides[i] > 0;
      below = below || sides[i] < 0;
    }
    if (above == below) faces |= 1u << mask;
  }
  return faces;
}

// Two simplices with the signs that several pairs of their faces need.
class FacePairs {
 public:
  FacePairs(const Simplex& a, const Simplex& b)
      : a_(a), b_(b), sides_a_(sides_of_corners(b, a)), sides_b_(sides_of_corners(a, b)) {}

  // Calls visit(mask of a, mask of b, same face?, how they meet) for all pairs of faces that meet.
  template <class Visit>
  void for_each_contact(Visit&& visit) {
    constexpr unsigned kAll = 0xff;
    const unsigned faces_a = b_.corners == 3 ? faces_at_plane(sides_a_, a_.corners) : kAll;
    const unsigned faces_b = a_.corners == 3 ? faces_at_plane(sides_b_, b_.corners) : kAll;
    for (unsigned mask_a = 1; mask_a < 1u << a_.corners; ++mask_a) {
      if ((faces_a >> mask_a & 1u) == 0) continue;
      for (unsigned mask_b = 1; mask_b < 1u << b_.corners; ++mask_b) {
        if ((faces_b >> mask_b & 1u) == 0) continue;
        if (same_face(a_, mask_a, b_, mask_b)) {
          visit(mask_a, mask_b, true, static_cast<Meet>(kCount[mask_a]));
          continue;
        }
        const Meet meet = faces_meet(mask_a, mask_b);
        if (meet != Meet::none) visit(mask_a, mask_b, false, meet);
      }
    }
  }

 private:
  // Meeting of the interiors of different faces.
  Meet faces_meet(unsigned mask_a, unsigned mask_b) {
    const unsigned count_a = kCount[mask_a], count_b = kCount[mask_b];
    const unsigned i = kBegin[mask_a], j = kBegin[mask_b];
    if (count_a == 1 && count_b == 1) return Meet::none;  // different vertices are different points
    if (count_a == 1) return vertex_meets(a_.point[i], sides_a_[i], b_, mask_b);
    if (count_b == 1) return vertex_meets(b_.point[j], sides_b_[j], a_, mask_a);
    if (count_a == 3 && count_b == 3) return facets_meet();
    if (count_a == 3) return side_meets_facet(b_, j, sides_b_, a_, [&](unsigned k) { return way(k, j); });
    if (count_b == 3) return side_meets_facet(a_, i, sides_a_, b_, [&](unsigned k) { return way(i, k); });
    if (way(i, j) != 0) return Meet::none;
    return segments_meet(a_.point[i], end(a_, i), b_.point[j], end(b_, j));
  }

  static Meet vertex_meets(const double* p, int side_p, const Simplex& other, unsigned mask) {
    const auto& j = kCorners[mask];
    const bool in =
        kCount[mask] == 2 ? in_segment(p, other.point[j[0]], other.point[j[1]]) : in_facet(p, side_p, other);
    return in ? Meet::point : Meet::none;
  }

  // Side i of one simplex against the other one, a facet; way(k) is for the side and the facet's side k.
  template <class Way>
  static Meet side_meets_facet(const Simplex& simplex, unsigned i, const Sides& sides, const Simplex& facet,
                               Way&& way) {
    const int side_p = sides[i], side_q = sides[next(simplex, i)];
    if (side_p == 0 && side_q == 0)
      return segment_meets_facet(simplex.point[i], 0, end(simplex, i), 0, facet);
    if (side_p * side_q >= 0) return Meet::none;
    // Whether the line passes all three sides of the facet in the same direction.
    const int first = way(0);
    return first != 0 && way(1) == first && way(2) == first ? Meet::point : Meet::none;
  }

  // For two facets, like holdfast::facets_meet. The signs of LineOrder are those of sides to or from the lone
  // corner.
  Meet facets_meet() {
    if (sides_a_ == Sides{0, 0, 0} || !both_signs(sides_a_) || !both_signs(sides_b_))
      return holdfast::facets_meet(a_, sides_a_, b_, sides_b_);
    const unsigned i = lone_corner(sides_a_), j = lone_corner(sides_b_);
    const int signs[] = {way(i, j), -way((i + 2) % 3, j), -way(i, (j + 2) % 3),
                         way((i + 2) % 3, (j + 2) % 3)};
    const bool before = std::any_of(std::begin(signs), std::end(signs), [](int s) { return s < 0; });
    const bool behind = std::any_of(std::begin(signs), std::end(signs), [](int s) { return s > 0; });
    return before && behind ? Meet::length : Meet::none;
  }

  static unsigned next(const Simplex& simplex, unsigned i) { return i + 1 == simplex.corners ? 0 : i + 1; }
  static const double* end(const Simplex& simplex, unsigned i) { return simplex.point[next(simplex, i)]; }

  // The direction in which sides i of a and j of b, from corners i and j to the next ones, pass each other.
  int way(unsigned i, unsigned j) {
    std::int8_t& known = ways_[3 * i + j];
    if (known == kUnknown)
      known = static_cast<std::int8_t>(exact::orient3d(a_.point[i], end(a_, i), b_.point[j], end(b_, j)));
    return known;
  }

  static constexpr std::int8_t kUnknown = 2;
  const Simplex &a_, &b_;
  const Sides sides_a_, sides_b_;
  std::array<std::int8_t, 9> ways_{kUnknown, kUnknown, kUnknown, kUnknown, kUnknown,
                                   kUnknown, kUnknown, kUnknown, kUnknown};
};

// --- Places

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
  Common& part = found.part;
  FacePairs(a, b).for_each_contact([&](unsigned mask_a, unsigned mask_b, bool same, Meet meet) {
    (same ? found.common : found.distinct) |= Contacts::bit(mask_a, mask_b);
    part.is_area = part.is_area || meet == Meet::area;
    if (meet != Meet::point) return;
    if (part.count < part.touches.size()) part.touches[part.count] = {mask_a, mask_b};
    ++part.count;
  });
  if (part.is_area) part.count = 0;
  return found;
}

std::vector<Point> common_corners(const Simplex& a, const Simplex& b) {
  std::vector<Point> corners;
  FacePairs(a, b).for_each_contact([&](unsigned mask_a, unsigned mask_b, bool, Meet meet) {
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
