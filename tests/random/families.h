// Random complexes of many kinds, small enough that a hundred thousand of them can be meshed in minutes.
//
// A complex depends on its number and the seed alone. Most are valid by construction or because the exact
// diagnosis was asked while they were made; the rest may be invalid, and small enough for the oracle of
// surface_oracle.h. Transformations are exact in doubles, so that they change no sign.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "dangling_surfaces.h"
#include "hard_surfaces.h"
#include "holdfast/holdfast.h"
#include "property/surface_oracle.h"

namespace holdfast::random_complexes {

using hard::integer;
using hard::log_uniform;
using hard::Random;
using hard::uniform;

struct Sample {
  Surface surface;
  Keep keep = Keep::automatic;
  bool mesh_known = false;  ///< a positive mesh in doubles exists: the complex was cut out of one
  bool coarse = false;      ///< doubles are so far apart that there may be no mesh in them
  std::vector<oracle::IntPoint> oracle_points = {};  ///< where the oracle is to decide whether it is valid
};

// ------------------------------------------------------------------------------------------ what others use

inline Index any(Random& random, std::size_t count) {
  return static_cast<Index>(integer(random, 0, static_cast<int>(count) - 1));
}

inline bool one_in(Random& random, int n) { return integer(random, 0, n - 1) == 0; }

// Coordinates are whole numbers from 0 to `size`, no two points the same.
inline std::vector<Point> grid_points(Random& random, int count, int size) {
  std::set<Point> seen;
  std::vector<Point> points;
  for (int k = 0; k < count; ++k) {
    const Point p{double(integer(random, 0, size)), double(integer(random, 0, size)),
                  double(integer(random, 0, size))};
    if (seen.insert(p).second) points.push_back(p);
  }
  return points;
}

inline std::vector<Point> loose_points(Random& random, int count) {
  std::vector<Point> points;
  for (int k = 0; k < count; ++k)
    points.push_back({uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)});
  return points;
}

// Leaves out vertices that `used` does not hold.
inline void keep_vertices(Surface& s, const std::set<Index>& used) {
  std::vector<Index> rank(s.vertices.size(), 0);
  std::vector<Point> vertices;
  for (const Index v : used) {
    rank[v] = static_cast<Index>(vertices.size());
    vertices.push_back(s.vertices[v]);
  }
  s.vertices = std::move(vertices);
  for (Triangle& f : s.facets)
    for (Index& v : f) v = rank[v];
  for (Segment& e : s.segments)
    for (Index& v : e) v = rank[v];
}

// ------------------------------------------------------------------------------------ cut out of a mesh

// One material a tetrahedron, 0 being outside: each at random, or that of the nearest of a few places.
inline std::vector<int> materials(Random& random, const std::vector<Point>& points,
                                  const std::vector<Tetrahedron>& tets) {
  const int most = integer(random, 1, 3);
  const bool in_lumps = integer(random, 0, 2) != 0;
  std::vector<std::pair<Point, int>> places;
  for (int k = 0; k < 6; ++k)
    places.emplace_back(points[any(random, points.size())], integer(random, 0, most));
  std::vector<int> of_tet;
  for (const Tetrahedron& t : tets) {
    const auto distance = [&](const Point& p) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double centre = (points[t[0]][k] + points[t[1]][k] + points[t[2]][k] + points[t[3]][k]) / 4;
        sum += (p[k] - centre) * (p[k] - centre);
      }
      return sum;
    };
    const auto nearest = std::min_element(places.begin(), places.end(), [&](const auto& a, const auto& b) {
      return distance(a.first) < distance(b.first);
    });
    of_tet.push_back(in_lumps ? nearest->second : integer(random, 0, most));
  }
  return of_tet;
}

// Faces between materials, and some faces and edges inside of one that dangle.
inline Surface cut_out(Random& random, const std::vector<Point>& points, const std::vector<Tetrahedron>& tets,
                       const std::vector<int>& material) {
  struct Sides {
    Triangle facet;
    std::vector<int> materials;
  };
  std::map<std::set<Index>, Sides> faces;
  for (std::size_t t = 0; t < tets.size(); ++t) {
    const auto [a, b, c, d] = tets[t];
    for (const Triangle& f : {Triangle{b, c, d}, Triangle{a, d, c}, Triangle{a, b, d}, Triangle{a, c, b}}) {
      Sides& sides = faces[{f[0], f[1], f[2]}];
      if (sides.materials.empty() || material[t] != 0) sides.facet = f;
      sides.materials.push_back(material[t]);
    }
  }
  const bool dangle = one_in(random, 3);
  Surface s;
  s.vertices = points;
  for (auto& [corners, sides] : faces) {
    auto& m = sides.materials;
    if (m.size() == 1) m.push_back(0);
    const bool inside = m[0] == m[1] && m[0] != 0;
    if (m[0] != m[1] || (inside && dangle && one_in(random, 10))) s.facets.push_back(sides.facet);
  }
  std::set<Index> used;
  for (std::size_t t = 0; t < tets.size(); ++t) {
    if (material[t] == 0) continue;
    used.insert(tets[t].begin(), tets[t].end());
    if (dangle && one_in(random, 8)) s.segments.push_back({tets[t][0], tets[t][1 + any(random, 3)]});
  }
  keep_vertices(s, used);
  return s;
}

inline std::vector<Point> points_of_some_kind(Random& random, int least, int most) {
  constexpr std::array<int, 7> kSizes{2, 3, 4, 8, 100, 10'000, 1 << 20};
  const int count = integer(random, least, most);
  return one_in(random, 4) ? loose_points(random, count)
                           : grid_points(random, count, kSizes[any(random, kSizes.size())]);
}

// Part of a Delaunay mesh of points in space or on a grid.
inline Sample part_of_mesh(Random& random, int most = 40) {
  while (true) {
    const std::vector<Point> points = points_of_some_kind(random, 4, integer(random, 5, most));
    const std::vector<Tetrahedron> tets = delaunay(points, random());
    if (tets.empty()) continue;
    const std::vector<int> material = materials(random, points, tets);
    if (std::all_of(material.begin(), material.end(), [](int m) { return m == 0; })) continue;
    return {cut_out(random, points, tets, material), Keep::bounded, true};
  }
}

// --------------------------------------------------------------------------------- valid by the diagnosis

// Vertices of a part of a mesh go where they will, as long as the complex stays valid.
inline Sample moved(Random& random) {
  Sample sample = part_of_mesh(random, integer(random, 6, 30));
  Surface& s = sample.surface;
  double size = 0;
  for (const Point& p : s.vertices)
    for (const double x : p) size = std::max(size, std::abs(x));
  const bool whole = size > 2 && !one_in(random, 3);
  const double least = one_in(random, 2) ? 1e-3 : 0.3;
  for (int k = 2 * static_cast<int>(s.vertices.size()); k > 0; --k)
    hard::try_adding(s, [&](Surface& next) {
      Point& p = next.vertices[any(random, next.vertices.size())];
      const double reach = size * log_uniform(random, least, 1);
      for (double& x : p) {
        x += uniform(random, -reach, reach);
        if (whole) x = std::round(x);
      }
    });
  sample.mesh_known = false;
  return sample;
}

// Triangles, segments and points among few points, most of them on a grid, in a box or in the open.
inline Sample soup(Random& random) {
  const bool on_grid = !one_in(random, 3);
  const int size = integer(random, 2, 8);
  Surface s;
  const bool boxed = one_in(random, 2);
  if (boxed) s = small::box({-1, -1, -1}, {size + 1.0, size + 1.0, size + 1.0});
  const auto point = [&]() -> Point {
    if (on_grid) return grid_points(random, 1, size)[0];
    return {uniform(random, 0, size), uniform(random, 0, size), uniform(random, 0, size)};
  };
  const auto vertex = [&](Surface& next) {
    if (next.vertices.size() > 8 && one_in(random, 2)) return any(random, next.vertices.size());
    next.vertices.push_back(point());
    return static_cast<Index>(next.vertices.size() - 1);
  };
  const int pieces = integer(random, 4, 25);
  for (int k = 0; k < pieces; ++k)
    hard::try_adding(s, [&](Surface& next) {
      const int kind = integer(random, 0, 5);
      if (kind == 0) next.vertices.push_back(point());
      if (kind == 1) next.segments.push_back({vertex(next), vertex(next)});
      if (kind > 1) next.facets.push_back({vertex(next), vertex(next), vertex(next)});
    });
  return {s, boxed ? Keep::automatic : Keep::box};
}

inline Sample pages(Random& random) {
  Surface s = small::box({-2, -2, -2}, {2, 2, 3});
  small::add_segment(s, {0, 0, 0}, {0, 0, 1});
  const auto foot = static_cast<Index>(s.vertices.size() - 2);
  double angle = uniform(random, 0, 7);
  for (int k = integer(random, 1, 12); k > 0; --k) {
    angle += one_in(random, 3) ? log_uniform(random, 1e-12, 1e-3) : uniform(random, 0, 2);
    hard::try_adding(s, [&](Surface& next) {
      next.vertices.push_back({std::cos(angle), std::sin(angle), uniform(random, 0, 1)});
      next.facets.push_back({foot, foot + 1, static_cast<Index>(next.vertices.size() - 1)});
    });
  }
  return {s, Keep::automatic};
}

// Twisted prisms and the like in one another, turned outwards or inwards at random.
inline Sample nested(Random& random) {
  Surface s;
  double radius = 1;
  for (int shell = integer(random, 2, 4); shell > 0; --shell) {
    Surface one = one_in(random, 2) ? hard::icosphere(0) : small::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
    for (Point& p : one.vertices) p = hard::scaled(p, radius);
    const bool turn = one_in(random, 2);
    hard::try_adding(s, [&](Surface& next) {
      const auto first = static_cast<Index>(next.vertices.size());
      next.vertices.insert(next.vertices.end(), one.vertices.begin(), one.vertices.end());
      for (const auto& [a, b, c] : one.facets)
        next.facets.push_back(turn ? Triangle{first + a, first + c, first + b}
                                   : Triangle{first + a, first + b, first + c});
    });
    radius *= one_in(random, 2) ? uniform(random, 0.2, 0.5) : 1 - log_uniform(random, 1e-6, 0.3);
  }
  return {s, one_in(random, 2) ? Keep::bounded : Keep::automatic};
}

inline Sample furnished(Random& random) {
  Surface s = one_in(random, 2)   ? small::box()
              : one_in(random, 2) ? hard::twisted_prism(random)
                                  : moved(random).surface;
  hard::Furniture(s, random).add(integer(random, 2, 12));
  return {s, Keep::box};
}

// What lies open: a closed surface without some of its facets.
inline Sample opened(Random& random) {
  Sample sample = one_in(random, 2) ? moved(random) : part_of_mesh(random, 20);
  auto& facets = sample.surface.facets;
  for (int k = integer(random, 1, 4); k > 0 && facets.size() > 1; --k)
    facets.erase(facets.begin() + any(random, facets.size()));
  sample.keep = Keep::box;
  sample.mesh_known = false;
  return sample;
}

template <Surface (*make_surface)(Random&)>
Sample closed(Random& random) {
  return {make_surface(random), Keep::automatic};
}
inline Sample lattice(Random& random) { return {hard::lattice(random), Keep::bounded, true}; }

inline Sample small_star(Random& random) {
  Surface s = hard::icosphere(0);
  const double least = log_uniform(random, 0.01, 0.9);
  for (Point& p : s.vertices) {
    for (double& x : p) x += uniform(random, -0.05, 0.05);
    p = hard::scaled(p, log_uniform(random, least, 1));
  }
  return {s, Keep::automatic};
}

// Anything on a small grid, valid or not; the oracle sees the same points.
inline Sample anything(Random& random) {
  Sample sample;
  sample.keep = Keep::box;
  for (const Point& p : grid_points(random, integer(random, 3, 9), integer(random, 1, 4))) {
    sample.surface.vertices.push_back(p);
    sample.oracle_points.push_back({oracle::Integer(p[0]), oracle::Integer(p[1]), oracle::Integer(p[2])});
  }
  const std::size_t n = sample.surface.vertices.size();
  const auto vertex = [&] { return any(random, n); };
  for (int k = integer(random, 1, 5); k > 0; --k)
    sample.surface.facets.push_back({vertex(), vertex(), vertex()});
  for (int k = integer(random, 0, 3); k > 0; --k) sample.surface.segments.push_back({vertex(), vertex()});
  return sample;
}

// ------------------------------------------------------------------------------------------------ maps

inline double largest_coordinate(const Surface& s) {
  double largest = 0;
  for (const Point& p : s.vertices)
    for (const double x : p) largest = std::max(largest, std::abs(x));
  return largest;
}

inline bool has_whole_numbers(const Surface& s) {
  return largest_coordinate(s) < 0x1p53 &&
         std::all_of(s.vertices.begin(), s.vertices.end(), [](const Point& p) {
           return p[0] == std::floor(p[0]) && p[1] == std::floor(p[1]) && p[2] == std::floor(p[2]);
         });
}

inline void as_it_is(Random&, Sample&) {}

// Every axis is stretched by a power of two: what was Delaunay no longer is.
inline void stretch(Random& random, Sample& sample) {
  const int most = one_in(random, 3) ? 40 : 8;
  for (std::size_t k = 0; k < 3; ++k) {
    const int power = integer(random, -most, most);
    for (Point& p : sample.surface.vertices) p[k] = std::ldexp(p[k], power);
  }
}

// One axis gets whole multiples of another, twice. Exact for whole numbers that stay below 2^53.
inline void shear(Random& random, Sample& sample) {
  if (!has_whole_numbers(sample.surface)) return stretch(random, sample);
  for (int k = 0; k < 2; ++k) {
    const auto to = static_cast<std::size_t>(integer(random, 0, 2)), from = (to + any(random, 2) + 1) % 3;
    const double factor = std::round(log_uniform(random, 1, 1000)) * (one_in(random, 2) ? 1 : -1);
    if (largest_coordinate(sample.surface) * (std::abs(factor) + 1) > 0x1p50) return;
    for (Point& p : sample.surface.vertices) p[to] += factor * p[from];
  }
}

// So far from the origin that doubles there are whole numbers, or halves, or quarters.
inline void move_far(Random& random, Sample& sample) {
  if (one_in(random, 2)) shear(random, sample);
  const double offset = std::ldexp(1.0, integer(random, 40, 52));
  if (!has_whole_numbers(sample.surface) || largest_coordinate(sample.surface) > offset / 2) return;
  sample.coarse = true;
  const int axes = integer(random, 1, 7);
  for (Point& p : sample.surface.vertices)
    for (std::size_t k = 0; k < 3; ++k)
      if ((axes >> k & 1) != 0) p[k] += offset;
}

// To the ends of the range of doubles: multiples of the least one, or next to overflow.
inline void scale_far(Random& random, Sample& sample) {
  int power = 0;
  static_cast<void>(std::frexp(largest_coordinate(sample.surface), &power));
  if (has_whole_numbers(sample.surface))
    power = one_in(random, 3) ? -1074 : integer(random, -1074, 1020 - power);
  else
    power = integer(random, 0, 1020 - power);
  sample.coarse = power < -1000;
  for (Point& p : sample.surface.vertices)
    for (double& x : p) x = std::ldexp(x, power);
}

// Keeps what is made of the vertices where it is valid. No mesh is known then.
template <typename Place>
void try_moving(Sample& sample, Place place) {
  Surface next = sample.surface;
  for (Point& p : next.vertices) place(p);
  if (!diagnose(next.view(), 1).empty()) return;
  sample.surface = std::move(next);
  sample.mesh_known = false;
  sample.oracle_points.clear();
}

// Nearly flat, with rounding, so that planes and lines hold only nearly.
inline void squeeze(Random& random, Sample& sample) {
  const double thickness = log_uniform(random, 1e-14, 1e-2), tilt = uniform(random, -1, 1);
  try_moving(sample, [&](Point& p) { p[2] = thickness * p[2] + tilt * p[0] + p[1] / 3; });
}

// The doubles next to 0 have none between them.
inline void move_by_ulps(Random& random, Sample& sample) {
  try_moving(sample, [&](Point& p) {
    for (double& x : p)
      for (int k = integer(random, 0, 3); k > 0; --k)
        x = std::nextafter(x, one_in(random, 2) ? -1e300 : 1e300);
  });
  for (const Point& p : sample.surface.vertices)
    for (const double x : p) sample.coarse |= x != 0 && std::abs(x) < 0x1p-1000;
}

struct Map {
  const char* name;
  void (*apply)(Random&, Sample&);
  int weight;
};

inline constexpr std::array<Map, 7> kMaps{{
    {"", as_it_is, 8},
    {", stretched", stretch, 4},
    {", sheared", shear, 4},
    {", far away", move_far, 3},
    {", scaled far", scale_far, 3},
    {", squeezed", squeeze, 2},
    {", moved by ulps", move_by_ulps, 2},
}};

struct Family {
  const char* name;
  Sample (*make)(Random&);
  int weight;
};

inline constexpr std::array<Family, 16> kFamilies{{
    {"parts of meshes", [](Random& r) { return part_of_mesh(r); }, 12},
    {"moved", moved, 24},
    {"soups", soup, 16},
    {"pages", pages, 4},
    {"nested", nested, 3},
    {"furnished", furnished, 6},
    {"opened", opened, 8},
    {"lattices", lattice, 3},
    {"voxels", closed<hard::voxels>, 2},
    {"twisted prisms", closed<hard::twisted_prism>, 5},
    {"small stars", small_star, 4},
    {"stars", closed<hard::star>, 1},
    {"sheets", closed<hard::sheet_over_floor>, 1},
    {"scattered", closed<hard::scattered>, 1},
    {"pencils", closed<hard::pencil>, 1},
    {"anything", anything, 10},
}};

template <typename Choices>
const auto& choose(Random& random, const Choices& choices) {
  int total = 0;
  for (const auto& choice : choices) total += choice.weight;
  int place = integer(random, 0, total - 1);
  const auto* choice = choices.data();
  while ((place -= choice->weight) >= 0) ++choice;
  return *choice;
}

/// How a complex is made: from these random numbers, and mapped.
struct Recipe {
  Random random;
  const Family& family;
  const Map& map;

  [[nodiscard]] Sample make() {
    Sample sample = family.make(random);
    map.apply(random, sample);
    return sample;
  }
};

inline Recipe recipe_of(std::uint64_t seed, std::uint64_t number) {
  std::seed_seq both{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                     static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(number >> 32)};
  Random random(both);
  const Family& family = choose(random, kFamilies);
  const Map& map = choose(random, kMaps);
  return {random, family, map};
}

}  // namespace holdfast::random_complexes
