// Valid surfaces at the ends of what doubles can tell, each with a mesh in doubles that is known to exist:
// everything is made of integer points and known to have a mesh on integer points, then sheared by a
// unimodular map, moved and scaled by a power of two, all without rounding.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <string>

#include "holdfast/holdfast.h"
#include "small_surfaces.h"

namespace holdfast::number_range {

using Random = std::mt19937_64;

struct Case {
  std::string name;
  Surface surface;
};

inline long between(Random& random, long low, long high) {
  return low + static_cast<long>(random() % static_cast<std::uint64_t>(high - low + 1));
}

inline double six_volumes(const Point& a, const Point& b, const Point& c, const Point& d) {
  std::array<std::array<double, 3>, 3> m{};
  for (std::size_t k = 0; k < 3; ++k) m[0][k] = b[k] - a[k], m[1][k] = c[k] - a[k], m[2][k] = d[k] - a[k];
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) +
         m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// An integer point that sees all facets from inside, of a surface with small integer coordinates whose
/// facets face outwards: the cone over it is a mesh.
inline std::optional<Point> centre_on_integers(const Surface& surface) {
  Point low = surface.vertices[0], high = low;
  for (const Point& p : surface.vertices)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  const auto sees_all = [&](const Point& x) {
    return std::all_of(surface.facets.begin(), surface.facets.end(), [&](const Triangle& f) {
      return six_volumes(surface.vertices[f[0]], surface.vertices[f[1]], surface.vertices[f[2]], x) < 0;
    });
  };
  for (double x = low[0]; x <= high[0]; ++x)
    for (double y = low[1]; y <= high[1]; ++y)
      for (double z = low[2]; z <= high[2]; ++z)
        if (sees_all({x, y, z})) return Point{x, y, z};
  return std::nullopt;
}

/// Schoenhardt's prism, rounded to whole numbers.
inline Surface schoenhardt(double radius, double height, double degrees) {
  Surface s;
  for (int k = 0; k < 6; ++k) {
    const double angle = std::numbers::pi * (120.0 * (k % 3) + (k < 3 ? 0 : degrees)) / 180;
    s.vertices.push_back(
        {std::round(radius * std::cos(angle)), std::round(radius * std::sin(angle)), k < 3 ? 0 : height});
  }
  s.facets = small::prism_facets({0, 2, 1}, {3, 4, 5});
  return s;
}

/// A cube whose diagonals ask for a point inside: at every corner either all three or none end.
inline Surface cube(double edge) {
  Surface s = small::box({0, 0, 0}, {edge, edge, edge});
  s.facets.clear();
  constexpr std::array<std::array<Index, 4>, 6> kSides{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  constexpr unsigned kPattern = 0b011001;  // found by search: no mesh without a point
  for (std::size_t side = 0; side < 6; ++side) {
    const auto& [a, b, c, d] = kSides[side];
    if (((kPattern >> side) & 1u) != 0) {
      s.facets.push_back({a, b, c});
      s.facets.push_back({a, c, d});
    } else {
      s.facets.push_back({a, b, d});
      s.facets.push_back({b, c, d});
    }
  }
  return s;
}

/// Integer points of a cube, some or all of them, in random order.
inline std::vector<Point> lattice_points(Random& random, long edge, std::size_t most_points) {
  std::vector<Point> points;
  for (long x = 0; x <= edge; ++x)
    for (long y = 0; y <= edge; ++y)
      for (long z = 0; z <= edge; ++z)
        points.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
  for (std::size_t k = points.size(); k > 1; --k) std::swap(points[k - 1], points[random() % k]);
  points.resize(std::min(points.size(), most_points));
  return points;
}

/// The boundary of some tetrahedra of a Delaunay mesh of integer points: grown at random, face by face. The
/// vertices inside it are left out.
inline Surface part_of_lattice_mesh(Random& random, const std::vector<Point>& points, std::size_t most_tets) {
  const std::vector<Tetrahedron> tets = delaunay(points, random());
  std::map<Triangle, std::vector<std::size_t>> by_face;
  const auto face = [&](std::size_t t, std::size_t i) {
    constexpr std::array<std::array<std::size_t, 3>, 4> kFace{{{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};
    const Tetrahedron& c = tets[t];
    return Triangle{c[kFace[i][0]], c[kFace[i][2]], c[kFace[i][1]]};  // outwards
  };
  const auto sorted = [](Triangle f) {
    std::sort(f.begin(), f.end());
    return f;
  };
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (std::size_t i = 0; i < 4; ++i) by_face[sorted(face(t, i))].push_back(t);
  std::vector<std::size_t> taken{random() % tets.size()};
  std::vector<bool> is_in(tets.size(), false);
  is_in[taken[0]] = true;
  const std::size_t wanted = 2 + random() % most_tets;
  for (int tries = 0; tries < 2000 && taken.size() < wanted; ++tries) {
    const std::vector<std::size_t>& two = by_face[sorted(face(taken[random() % taken.size()], random() % 4))];
    for (const std::size_t t : two)
      if (!is_in[t]) {
        is_in[t] = true;
        taken.push_back(t);
      }
  }
  constexpr Index kUnused = ~Index{0};
  Surface s;
  std::vector<Index> index(points.size(), kUnused);
  for (const std::size_t t : taken)
    for (std::size_t i = 0; i < 4; ++i) {
      const Triangle f = face(t, i);
      const std::vector<std::size_t>& two = by_face[sorted(f)];
      if (two.size() == 2 && is_in[two[0]] && is_in[two[1]]) continue;
      Triangle out{};
      for (std::size_t k = 0; k < 3; ++k) {
        if (index[f[k]] == kUnused) {
          index[f[k]] = static_cast<Index>(s.vertices.size());
          s.vertices.push_back(points[f[k]]);
        }
        out[k] = index[f[k]];
      }
      s.facets.push_back(out);
    }
  return s;
}

/// x += a y, y += b z and the like, `steps` times: a unimodular map of the integer points.
inline void shear(Surface& s, Random& random, int steps, long most) {
  for (int step = 0; step < steps; ++step) {
    const std::size_t i = random() % 3, j = (i + 1 + random() % 2) % 3;
    const auto times = static_cast<double>(between(random, -most, most));
    for (Point& p : s.vertices) p[i] += times * p[j];
  }
}

inline void move(Surface& s, const Point& by) {
  for (Point& p : s.vertices)
    for (std::size_t k = 0; k < 3; ++k) p[k] += by[k];
}
inline void scale(Surface& s, int exponent) {
  for (Point& p : s.vertices)
    for (double& x : p) x = std::ldexp(x, exponent);
}
inline void append(Surface& s, const Surface& other) {
  const auto first = static_cast<Index>(s.vertices.size());
  s.vertices.insert(s.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Triangle& f : other.facets) s.facets.push_back({first + f[0], first + f[1], first + f[2]});
}

inline double extent(const Surface& s) {
  double most = 0;
  for (const Point& p : s.vertices)
    for (const double x : p) most = std::max(most, std::abs(x));
  return most;
}

/// One piece on integer points with a mesh on integer points.
inline Case piece(Random& random) {
  switch (random() % 5) {
    case 0:
      for (;;) {
        const double radius = static_cast<double>(between(random, 3, 12)),
                     height = static_cast<double>(between(random, 3, 12)),
                     twist = static_cast<double>(between(random, 15, 45));
        Surface s = schoenhardt(radius, height, twist);
        if (centre_on_integers(s)) return {"prism", std::move(s)};
      }
    case 1:
      return {"cube", cube(static_cast<double>(between(random, 2, 4)))};
    case 2: {  // walls one unit thick
      Surface s = small::nested((random() & 1u) == 0);
      return {"nested", std::move(s)};
    }
    case 3:
      return {"part", part_of_lattice_mesh(random,
                                           lattice_points(random, between(random, 2, 5),
                                                          static_cast<std::size_t>(between(random, 9, 25))),
                                           static_cast<std::size_t>(between(random, 4, 60)))};
    default: {  // of tetrahedra that hold no integer point but their corners
      const std::vector<Point> points = lattice_points(random, between(random, 2, 4), 1000);
      return {"unit part",
              part_of_lattice_mesh(random, points, static_cast<std::size_t>(between(random, 4, 200)))};
    }
  }
}

/// The n-th of a fixed sequence.
inline Case number(std::uint64_t n) {
  Random random(n);
  Case out = piece(random);
  Surface& s = out.surface;
  const std::uint64_t sheared = random() % 3;
  if (sheared == 1) shear(s, random, 2, 10);
  if (sheared == 2) shear(s, random, 4, 30);
  if (sheared > 0) out.name += " sheared";
  const std::uint64_t moved = random() % 4;
  if (moved > 0) {  // the spacing of the doubles is at most one up to 2^53
    Point by{};
    for (double& x : by) {
      const int exponent = static_cast<int>(between(random, moved == 1 ? 49 : 0, 52));
      x = std::ldexp(1.0, exponent);
      if (moved == 3) x -= static_cast<double>(between(random, 0, 40));  // across the border of a binade
      if (random() % 3 == 0) x = -x;
      if (moved == 2) x += std::ldexp(1.0, 20);
    }
    const Point before{extent(s), 0, 0};
    if (before[0] < 0x1p20) {
      move(s, by);
      out.name += " moved";
    }
  }
  const int room = 1022 - std::ilogb(extent(s));
  switch (random() % 5) {
    case 0:
      break;
    case 1:
      scale(s, -1074);
      out.name += " least";
      break;
    case 2:
      scale(s, room);
      out.name += " greatest";
      break;
    case 3: {
      const int k = static_cast<int>(between(random, -1074, room));
      scale(s, k);
      out.name += " times 2^" + std::to_string(k);
      break;
    }
    default: {  // two pieces of different size, or the second one far away
      Case second = piece(random);
      const bool least = random() % 2 == 0 && extent(s) < 0x1p53;
      if (least) scale(s, -1074);
      scale(second.surface, static_cast<int>(between(random, least ? -900 : 0, 900)));
      const double gap = 4 * (extent(s) + extent(second.surface));
      const double far = std::ldexp(1.0, std::ilogb(gap));
      Surface moved_second = second.surface;
      move(moved_second, {far, 0, 0});
      bool exact = true;
      for (std::size_t v = 0; v < moved_second.vertices.size(); ++v)
        exact = exact && moved_second.vertices[v][0] - far == second.surface.vertices[v][0];
      if (exact && std::ilogb(far) - std::ilogb(extent(second.surface)) < 40) {
        append(s, moved_second);
        out.name += " and " + second.name;
      }
      break;
    }
  }
  out.name = std::to_string(n) + ": " + out.name;
  return out;
}

}  // namespace holdfast::number_range
