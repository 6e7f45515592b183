// Small handmade meshes, with the surfaces that they fill, as cases for check().
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "holdfast/check.h"

namespace holdfast::check_cases {

struct Case {
  Surface surface;
  Volume volume;
  CheckOptions options;

  [[nodiscard]] CheckResult checked() const { return check(surface.view(), volume, options); }
};

using Names = std::set<std::string>;

inline Names broken(const CheckResult& result) {
  Names names;
  for (const Rule& rule : result.rules)
    if (!rule.holds) names.insert(rule.name);
  return names;
}

inline Names broken(const Case& c) { return broken(c.checked()); }

inline std::string detail(const Case& c, const std::string& name) {
  for (const Rule& rule : c.checked().rules)
    if (rule.name == name) return rule.detail;
  return "no such rule";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

using Cell = std::array<int, 3>;
/// The region id of the cell at (x, y, z), or 0 to leave the cell out.
using RegionOf = std::function<int(int, int, int)>;

inline const RegionOf one_region = [](int, int, int) { return 1; };

/// Adds a box of unit cells, six tetrahedra each (Kuhn): all cells are cut along parallel diagonals.
inline void add_grid(Volume& volume, Cell cells, const RegionOf& region_of, Point origin = {0, 0, 0}) {
  std::map<Cell, Index> index;
  const auto vertex = [&](const Cell& at) {
    const auto [place, added] = index.try_emplace(at, static_cast<Index>(volume.vertices.size()));
    if (added) volume.vertices.push_back({origin[0] + at[0], origin[1] + at[1], origin[2] + at[2]});
    return place->second;
  };
  const auto add_cell = [&](const Cell& cell, int id) {
    std::array<std::size_t, 3> order{0, 1, 2};
    do {
      Cell at = cell;
      Tetrahedron t{vertex(at)};
      for (std::size_t i = 0; i < 3; ++i) {
        ++at[order[i]];
        t[i + 1] = vertex(at);
      }
      const bool even = (order[1] + 3 - order[0]) % 3 == 1;
      if (!even) std::swap(t[2], t[3]);
      volume.tetrahedra.push_back(t);
      volume.regions.push_back(id);
    } while (std::next_permutation(order.begin(), order.end()));
  };
  for (int z = 0; z < cells[2]; ++z)
    for (int y = 0; y < cells[1]; ++y)
      for (int x = 0; x < cells[0]; ++x)
        if (const int id = region_of(x, y, z); id != 0) add_cell({x, y, z}, id);
}

inline Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// The surface that a volume fills: faces of only one tetrahedron, and faces between different ids.
inline Surface boundary_of(const Volume& volume) {
  std::map<Triangle, std::vector<int>> ids;
  for (std::size_t i = 0; i < volume.tetrahedra.size(); ++i) {
    const Tetrahedron& t = volume.tetrahedra[i];
    for (const Triangle& face : {Triangle{t[0], t[1], t[2]}, Triangle{t[0], t[1], t[3]},
                                 Triangle{t[0], t[2], t[3]}, Triangle{t[1], t[2], t[3]}})
      ids[sorted(face)].push_back(volume.regions[i]);
  }
  Surface surface;
  surface.vertices = volume.vertices;
  for (const auto& [face, of] : ids)
    if (of.size() == 1 || of[0] != of[1]) surface.facets.push_back(face);
  return surface;
}

inline Case filled(Volume volume) {
  Case c;
  c.surface = boundary_of(volume);
  c.volume = std::move(volume);
  return c;
}

inline Case grid(Cell cells, const RegionOf& region_of = one_region) {
  Volume volume;
  add_grid(volume, cells, region_of);
  return filled(std::move(volume));
}

inline Index vertex_at(const Volume& volume, const Point& point) {
  return static_cast<Index>(std::find(volume.vertices.begin(), volume.vertices.end(), point) -
                            volume.vertices.begin());
}

/// Exchanges two vertices' indices in the volume.
inline void exchange(Volume& volume, Index x, Index y) {
  std::swap(volume.vertices[x], volume.vertices[y]);
  for (Tetrahedron& t : volume.tetrahedra)
    for (Index& v : t) v = v == x ? y : v == y ? x : v;
}

/// A 2x2x2 grid whose middle is a Steiner point, the last vertex.
inline Case with_steiner() {
  Case c = grid({2, 2, 2});
  exchange(c.volume, vertex_at(c.volume, {1, 1, 1}), static_cast<Index>(c.volume.vertices.size() - 1));
  c.surface = boundary_of(c.volume);
  c.surface.vertices.pop_back();
  return c;
}

/// A 3x3x3 grid whose input is only the middle cell: the rest reaches to a box.
inline Case in_box() {
  Case c = grid({3, 3, 3}, [](int x, int y, int z) { return x == 1 && y == 1 && z == 1 ? 2 : 1; });
  const auto outer = [&](Index v) {
    return std::ranges::any_of(c.volume.vertices[v], [](double x) { return x < 1 || x > 2; });
  };
  std::erase_if(c.surface.facets, [&](const Triangle& facet) { return std::ranges::any_of(facet, outer); });
  return c;
}

inline void append_grid(Volume& to, Cell cells, const Point& origin) {
  add_grid(to, cells, one_region, origin);
}

inline void drop_tetrahedron(Volume& volume, std::size_t i) {
  volume.tetrahedra.erase(volume.tetrahedra.begin() + static_cast<std::ptrdiff_t>(i));
  volume.regions.erase(volume.regions.begin() + static_cast<std::ptrdiff_t>(i));
}

/// One tetrahedron and the surface that it fills.
inline Case one_tetrahedron() {
  Volume volume;
  volume.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  volume.tetrahedra = {{0, 1, 2, 3}};
  volume.regions = {1};
  return filled(std::move(volume));
}

inline int from_border(int i, int cells) { return std::min(i, cells - 1 - i); }

inline int depth(int x, int y, int z, int cells) {
  return std::min({from_border(x, cells), from_border(y, cells), from_border(z, cells)});
}

}  // namespace holdfast::check_cases
