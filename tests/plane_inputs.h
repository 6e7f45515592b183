// Random points and segments in the plane, valid by construction, and what must hold of their triangles.
#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "exact/dyadic.h"
#include "exact/predicates.h"
#include "holdfast/plane.h"
#include "numbers/random.h"

namespace holdfast::testing {

/// The three methods, and what one of them has a choice of.
struct Way {
  PlaneMethod method;
  PlaneEars ears = PlaneEars::first;
  bool partition_first = false;
};
inline constexpr Way kWays[] = {{PlaneMethod::ears},
                                {PlaneMethod::ears, PlaneEars::best},
                                {PlaneMethod::ears, PlaneEars::join},
                                {PlaneMethod::swaps},
                                {PlaneMethod::partition},
                                {PlaneMethod::partition, PlaneEars::first, true}};

inline bool lies_between(const PlanePoint& a, const PlanePoint& b, const PlanePoint& p) {
  return exact::orient2d(a.data(), b.data(), p.data()) == 0 && p != a && p != b && std::min(a, b) < p &&
         p < std::max(a, b);
}

/// Whether two segments between points of a list may stand beside each other.
inline bool fit(const Plane& plane, const Segment& s, const Segment& t) {
  const auto at = [&](Index v) { return plane.points[v].data(); };
  const auto side = [&](const Segment& line, Index v) {
    return exact::orient2d(at(line[0]), at(line[1]), at(v));
  };
  if ((s[0] == t[0] && s[1] == t[1]) || (s[0] == t[1] && s[1] == t[0])) return false;
  const int c = side(s, t[0]), d = side(s, t[1]), a = side(t, s[0]), b = side(t, s[1]);
  return !(c * d < 0 && a * b < 0);
}

enum class Coordinates { grid, random, tiny, huge, at_2_52, clustered };
inline constexpr int kCoordinateKinds = 6;

inline PlanePoint random_point(Coordinates kind, int size, numbers::Random& random) {
  const auto whole = [&] {
    return static_cast<double>(numbers::below(static_cast<std::uint64_t>(size), random));
  };
  const auto real = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  switch (kind) {
    case Coordinates::grid:
      return {whole(), whole()};
    case Coordinates::random:
      return {real(), real()};
    case Coordinates::tiny:
      return {whole() * 0x1p-1074, whole() * 0x1p-1074};
    case Coordinates::huge:
      return {(real() - 0.5) * 2e301, (real() - 0.5) * 2e301};
    case Coordinates::at_2_52:
      return {0x1p52 + whole(), 0x1p52 + whole()};
    case Coordinates::clustered: {
      const double scale = std::ldexp(1.0, -static_cast<int>(numbers::below(60, random)));
      return {real() * scale, real() * scale};
    }
  }
  return {};
}

/// Points and at most `most` segments that are valid: outlines first by chance, since short segments close
/// regions more often than long ones.
inline Plane random_plane(std::uint64_t seed, std::size_t most = 200) {
  numbers::Random random(seed);
  const auto kind = static_cast<Coordinates>(numbers::below(kCoordinateKinds, random));
  const std::size_t wanted = numbers::below(most + 1, random);
  const std::size_t count = 3 + wanted / 3 + numbers::below(wanted + 2, random);
  const int size = 2 + static_cast<int>(std::sqrt(static_cast<double>(count)) *
                                        (1 + static_cast<double>(numbers::below(3, random))));
  Plane plane;
  std::set<PlanePoint> places;
  for (std::size_t i = 0; i < count; ++i) {
    const PlanePoint p = random_point(kind, size, random);
    if (places.insert(p).second) plane.points.push_back(p);
  }
  const std::uint64_t n = plane.points.size();
  for (std::size_t tries = 0; plane.segments.size() < wanted && tries < 12 * wanted; ++tries) {
    const auto a = static_cast<Index>(numbers::below(n, random));
    auto b = static_cast<Index>(numbers::below(n, random));
    // Of some points the nearest to a.
    for (std::uint64_t k = numbers::below(20, random); k > 0; --k) {
      const auto c = static_cast<Index>(numbers::below(n, random));
      const auto distance = [&](Index v) {
        return std::abs(plane.points[v][0] - plane.points[a][0]) +
               std::abs(plane.points[v][1] - plane.points[a][1]);
      };
      if (c != a && (b == a || distance(c) < distance(b))) b = c;
    }
    if (a == b) continue;
    const Segment s{a, b};
    const bool blocked = std::any_of(plane.points.begin(), plane.points.end(), [&](const PlanePoint& p) {
      return lies_between(plane.points[a], plane.points[b], p);
    });
    if (blocked || !std::all_of(plane.segments.begin(), plane.segments.end(),
                                [&](const Segment& t) { return fit(plane, s, t); }))
      continue;
    plane.segments.push_back(s);
  }
  return plane;
}

/// Spoils a valid input in one way: a point again, off to infinity or on a segment, a segment that crosses,
/// overlaps, stands twice or has no length, a hole on a segment. What a message must name; nothing where the
/// input has no place for it.
struct Spoilt {
  DefectKind kind;
  std::vector<Index> vertices, segments;
};
inline std::optional<Spoilt> spoil(Plane& plane, numbers::Random& random) {
  const auto any = [&](std::size_t n) { return static_cast<Index>(numbers::below(n, random)); };
  const auto last_point = [&] { return static_cast<Index>(plane.points.size() - 1); };
  const auto last_segment = [&] { return static_cast<Index>(plane.segments.size() - 1); };
  const std::uint64_t way = numbers::below(8, random);
  if (way == 0) {
    const Index v = any(plane.points.size());
    plane.points.push_back(plane.points[v]);
    return Spoilt{DefectKind::repeated_vertex, {v, last_point()}, {}};
  }
  if (way == 1) {
    const Index v = any(plane.points.size());
    plane.segments.push_back({v, v});
    return Spoilt{DefectKind::degenerate_segment, {v, v}, {last_segment()}};
  }
  if (way == 6) {
    const Index v = any(plane.points.size());
    plane.points[v][v % 2] = v % 3 == 0 ? std::nan("") : -HUGE_VAL;
    return Spoilt{DefectKind::non_finite_coordinate, {v}, {}};
  }
  if (plane.segments.empty()) return std::nullopt;
  const Index s = any(plane.segments.size());
  const auto [a, b] = plane.segments[s];
  if (way == 2) {
    plane.segments.push_back({b, a});
    return Spoilt{DefectKind::segments_overlap, {}, {s, last_segment()}};
  }
  if (way == 3 || way == 4 || way == 7) {
    // The middle, where doubles have it: a point alone, the end of a segment that overlaps, or a hole.
    const PlanePoint &p = plane.points[a], &q = plane.points[b];
    const PlanePoint middle{p[0] / 2 + q[0] / 2, p[1] / 2 + q[1] / 2};
    if (!lies_between(p, q, middle)) return std::nullopt;
    if (std::find(plane.points.begin(), plane.points.end(), middle) != plane.points.end())
      return std::nullopt;
    if (way == 7) {
      plane.holes.push_back(middle);
      return Spoilt{DefectKind::vertex_in_segment, {}, {s}};
    }
    plane.points.push_back(middle);
    if (way == 3) return Spoilt{DefectKind::vertex_in_segment, {last_point()}, {s}};
    plane.segments.push_back({a, last_point()});
    return Spoilt{DefectKind::segments_overlap, {}, {s, last_segment()}};
  }
  for (int tries = 0; tries < 50; ++tries) {
    const Segment t{any(plane.points.size()), any(plane.points.size())};
    const auto at = [&](Index v) { return plane.points[v].data(); };
    if (exact::orient2d(at(a), at(b), at(t[0])) * exact::orient2d(at(a), at(b), at(t[1])) >= 0 ||
        exact::orient2d(at(t[0]), at(t[1]), at(a)) * exact::orient2d(at(t[0]), at(t[1]), at(b)) >= 0)
      continue;
    plane.segments.push_back(t);
    return Spoilt{DefectKind::segments_cross, {}, {s, last_segment()}};
  }
  return std::nullopt;
}

/// Twice the area, exactly.
inline exact::Dyadic double_area(const PlaneMesh& mesh) {
  exact::Dyadic sum;
  for (const Triangle& t : mesh.triangles) {
    const auto difference = [&](std::size_t i, std::size_t k) {
      return exact::Dyadic(mesh.points[t[i]][k]) - exact::Dyadic(mesh.points[t[0]][k]);
    };
    sum += difference(1, 0) * difference(2, 1) - difference(1, 1) * difference(2, 0);
  }
  return sum;
}

/// The least box that holds some points: what is true of none in it need not be asked of those outside.
struct PlaneBox {
  PlanePoint low, high;
  PlaneBox(std::initializer_list<PlanePoint> points) : low(*points.begin()), high(low) {
    for (const PlanePoint& p : points)
      for (std::size_t k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
  }
  [[nodiscard]] bool meets(const PlaneBox& other) const {
    return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] &&
           other.low[1] <= high[1];
  }
};

/// What is wrong with triangles of a plane: nothing, or one sentence. `delaunay`: each must be constrained
/// Delaunay.
inline std::string fault_of(const Plane& plane, const PlaneMesh& mesh, bool delaunay) {
  if (mesh.triangles.empty()) return {};
  if (mesh.points != plane.points) return "the points are not those of the input";
  const auto at = [&](Index v) { return mesh.points[v].data(); };
  std::set<std::pair<Index, Index>> constraints;
  for (const Segment& s : plane.segments) constraints.insert({std::min(s[0], s[1]), std::max(s[0], s[1])});
  std::map<std::pair<Index, Index>, Index> apex;  // of directed sides
  std::vector<bool> used(mesh.points.size(), false);
  for (const Triangle& t : mesh.triangles) {
    if (exact::orient2d(at(t[0]), at(t[1]), at(t[2])) <= 0) return "a triangle is not positive";
    for (std::size_t i = 0; i < 3; ++i) {
      used[t[i]] = true;
      if (!apex.insert({{t[i], t[(i + 1) % 3]}, t[(i + 2) % 3]}).second)
        return "triangles overlap at an edge";
    }
    const PlaneBox box{mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
    for (Index v = 0; v < mesh.points.size(); ++v) {
      if (v == t[0] || v == t[1] || v == t[2] || !box.meets({mesh.points[v]})) continue;
      bool inside = true;
      for (std::size_t i = 0; i < 3 && inside; ++i)
        inside = exact::orient2d(at(t[i]), at(t[(i + 1) % 3]), at(v)) >= 0;
      if (inside) return "point " + std::to_string(v) + " lies in a triangle";
    }
    for (const auto& [a, b] : plane.segments) {
      if (!box.meets({mesh.points[a], mesh.points[b]})) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        const Index p = t[i], q = t[(i + 1) % 3];
        const int c = exact::orient2d(at(a), at(b), at(p)), d = exact::orient2d(at(a), at(b), at(q));
        const int e = exact::orient2d(at(p), at(q), at(a)), f = exact::orient2d(at(p), at(q), at(b));
        if (c * d < 0 && e * f < 0) return "a side crosses a segment";
      }
    }
  }
  for (const auto& [side, corner] : apex) {
    const auto other = apex.find({side.second, side.first});
    const bool constrained =
        constraints.contains({std::min(side.first, side.second), std::max(side.first, side.second)});
    if (other == apex.end()) {
      if (!constrained && !plane.segments.empty()) return "a border edge is no segment";
      continue;
    }
    if (delaunay && !constrained) {
      // By the lifted tetrahedron, since the in-circle predicate is what is tested.
      const auto lift = [&](Index v) {
        const exact::Dyadic x(mesh.points[v][0]), y(mesh.points[v][1]);
        return std::array<exact::Dyadic, 3>{x, y, x * x + y * y};
      };
      const auto o = lift(other->second), a = lift(side.first), b = lift(side.second), c = lift(corner);
      std::array<std::array<exact::Dyadic, 3>, 3> rows;
      for (std::size_t k = 0; k < 3; ++k)
        rows[0][k] = a[k] - o[k], rows[1][k] = b[k] - o[k], rows[2][k] = c[k] - o[k];
      const auto minor = [&](std::size_t i, std::size_t j) {
        return rows[i][0] * rows[j][1] - rows[j][0] * rows[i][1];
      };
      if ((minor(1, 2) * rows[0][2] + minor(2, 0) * rows[1][2] + minor(0, 1) * rows[2][2]).sign() > 0)
        return "an edge is not Delaunay";
    }
  }
  return {};
}

}  // namespace holdfast::testing
