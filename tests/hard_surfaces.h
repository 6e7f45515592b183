// Random valid complexes that are hard to fill: stars, twisted prisms, lattices, shells, notched boxes.
//
// All are simplicial complexes by construction, so that nothing has to be tested for validity, but for
// `scattered`, which asks the exact diagnosis.
#pragma once

#include <cmath>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "enforce/polygon.h"
#include "holdfast/holdfast.h"
#include "mesh/editor.h"
#include "small_surfaces.h"

namespace holdfast::hard {

using Random = std::mt19937_64;
inline constexpr double kPi = 3.14159265358979323846;

inline double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
inline int integer(Random& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}
// A random size over many magnitudes.
inline double log_uniform(Random& random, double low, double high) {
  return std::exp(uniform(random, std::log(low), std::log(high)));
}

inline Point scaled(const Point& p, double factor) { return {p[0] * factor, p[1] * factor, p[2] * factor}; }

// Unit vectors that make a triangulated sphere of 20 * 4^level triangles, turned outwards.
inline Surface icosphere(int level) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  Surface s;
  s.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  s.facets = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
              {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
              {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int k = 0; k < level; ++k) {
    std::map<std::pair<Index, Index>, Index> middle;
    const auto half = [&](Index a, Index b) {
      const auto [it, fresh] = middle.try_emplace(std::minmax(a, b), static_cast<Index>(s.vertices.size()));
      const Point p = s.vertices[a], q = s.vertices[b];
      if (fresh) s.vertices.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
      return it->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : s.facets) {
      const Index ab = half(a, b), bc = half(b, c), ca = half(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    s.facets = finer;
    for (Point& p : s.vertices) p = scaled(p, 1 / std::hypot(p[0], p[1], p[2]));
  }
  return s;
}

// Star-shaped round the origin: every direction of a triangulated sphere has a radius of its own.
inline Surface star(Random& random) {
  Surface s = icosphere(integer(random, 1, 2));
  const double least = log_uniform(random, 0.01, 0.9);
  for (Point& p : s.vertices) {
    for (double& x : p) x += uniform(random, -0.05, 0.05);
    p = scaled(p, log_uniform(random, least, 1));
  }
  return s;
}

// A sphere with thin spikes that reach far out and deep in, almost to the centre.
inline Surface spikes(Random& random) {
  Surface s = icosphere(2);
  for (Point& p : s.vertices) {
    const int kind = integer(random, 0, 5);
    p = scaled(p, kind == 0   ? uniform(random, 3, 30)
                  : kind == 1 ? log_uniform(random, 1e-3, 0.1)
                              : uniform(random, 0.9, 1));
  }
  return s;
}

// Two n-gons, one turned against the other, with side diagonals that bend inwards: Schönhardt's for n = 3.
// Adding all prisms' worth of twist, 180 - 360 / n degrees, would make the diagonals meet on the axis.
inline Surface twisted_prism(Random& random) {
  const auto n = static_cast<Index>(integer(random, 3, 9));
  const double twist = uniform(random, 0.03, 0.97) * (kPi - 2 * kPi / n);
  const double height = log_uniform(random, 0.05, 20);
  Surface s;
  for (Index k = 0; k < 2 * n; ++k) {
    const double angle = 2 * kPi * (k % n) / n + (k < n ? 0 : twist);
    s.vertices.push_back({std::cos(angle), std::sin(angle), k < n ? 0 : height});
  }
  for (Index k = 1; k + 1 < n; ++k) {
    s.facets.push_back({0, k + 1, k});
    s.facets.push_back({n, n + k, n + k + 1});
  }
  for (Index k = 0; k < n; ++k) {
    const Index j = (k + 1) % n;
    s.facets.push_back({k, j, n + j});
    s.facets.push_back({k, n + j, n + k});
  }
  return s;
}

// A bumpy sheet of n x n squares close over a floor of two triangles, with walls: hundreds of edges pierce
// each of these (the paper's Fig. 15).
inline Surface sheet_over_floor(Random& random) {
  const auto n = static_cast<Index>(integer(random, 4, 16));
  const double height = log_uniform(random, 1e-3, 1);
  Surface s;
  const auto at = [&](Index i, Index j) { return i * (n + 1) + j; };
  for (Index i = 0; i <= n; ++i)
    for (Index j = 0; j <= n; ++j) {
      const bool border = i == 0 || j == 0 || i == n || j == n;
      s.vertices.push_back({1.0 * i / n, 1.0 * j / n, height * (border ? 1 : uniform(random, 0.5, 1.5))});
    }
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      s.facets.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      s.facets.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  const Index floor = at(n, n) + 1;
  s.vertices.insert(s.vertices.end(), {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  s.facets.push_back({floor, floor + 2, floor + 1});
  s.facets.push_back({floor, floor + 3, floor + 2});
  const auto border = [&](Index side, Index k) {
    return side == 0 ? at(k, 0) : side == 1 ? at(n, k) : side == 2 ? at(n - k, n) : at(0, n - k);
  };
  for (Index side = 0; side < 4; ++side) {
    const Index a = floor + side, b = floor + (side + 1) % 4;
    s.facets.push_back({a, b, border(side, n)});
    for (Index k = 0; k < n; ++k) s.facets.push_back({a, border(side, k + 1), border(side, k)});
  }
  return s;
}

// Copies of one sphere, each inside the one before, thick or very thin between them; all turned outwards,
// or by turns so that every other shell is hollow.
inline Surface nested_spheres(Random& random) {
  Surface s;
  const Surface unit = icosphere(1);
  const bool alternate = integer(random, 0, 1) == 1;
  double radius = 1;
  for (int shell = 0; shell < 3; ++shell) {
    const auto first = static_cast<Index>(s.vertices.size());
    for (const Point& p : unit.vertices) s.vertices.push_back(scaled(p, radius));
    for (const auto& [a, b, c] : unit.facets)
      s.facets.push_back(alternate && shell == 1 ? Triangle{first + a, first + c, first + b}
                                                 : Triangle{first + a, first + b, first + c});
    radius *= 1 - log_uniform(random, 1e-4, 0.5);
  }
  return s;
}

// A grid of cells with planes at irregular places; vertices are made where they are asked for.
class Grid {
 public:
  Grid(Random& random, int nx, int ny, int nz, double jitter) : random_(random), n_{nx, ny, nz} {
    for (std::size_t k = 0; k < 3; ++k) {
      double x = 0;
      for (int i = 0; i <= n_[k]; ++i) {
        place_[k].push_back(x);
        x += log_uniform(random, 0.2, 1);
      }
    }
    jitter_ = 0.05 * jitter;  // a quarter of the thinnest cell at most
  }

  using Cell = std::array<int, 3>;
  [[nodiscard]] const Cell& size() const { return n_; }
  Index vertex(const Cell& at) {
    const auto [it, fresh] = vertices_.try_emplace(at, static_cast<Index>(surface.vertices.size()));
    if (fresh) {
      Point p{};
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = place_[k][static_cast<std::size_t>(at[k])] + jitter_ * uniform(random_, -1, 1);
      surface.vertices.push_back(p);
    }
    return it->second;
  }

  Surface surface;

 private:
  Random& random_;
  Cell n_;
  std::array<std::vector<double>, 3> place_;
  std::map<Cell, Index> vertices_;
  double jitter_ = 0;
};

// The boundary of a set of cells, turned outwards; each square is cut along either diagonal. Edges and
// vertices may be non-manifold.
template <typename Filled>
Surface boundary_of_cells(Random& random, Grid& grid, Filled filled) {
  const auto [nx, ny, nz] = grid.size();
  const auto is_filled = [&](const Grid::Cell& c) {
    for (std::size_t k = 0; k < 3; ++k)
      if (c[k] < 0 || c[k] >= grid.size()[k]) return false;
    return filled(c);
  };
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y)
      for (int z = 0; z < nz; ++z) {
        if (!is_filled({x, y, z})) continue;
        for (std::size_t axis = 0; axis < 3; ++axis)
          for (int side = 0; side < 2; ++side) {
            Grid::Cell across{x, y, z};
            across[axis] += side == 1 ? 1 : -1;
            if (is_filled(across)) continue;
            std::array<Index, 4> q{};
            for (std::size_t k = 0; k < 4; ++k) {
              Grid::Cell corner{x, y, z};
              corner[axis] += side;
              corner[(axis + 1) % 3] += k == 1 || k == 2 ? 1 : 0;
              corner[(axis + 2) % 3] += k >= 2 ? 1 : 0;
              q[k] = grid.vertex(corner);
            }
            if (side == 0) std::swap(q[1], q[3]);
            if (integer(random, 0, 1) == 1) q = {q[1], q[2], q[3], q[0]};
            grid.surface.facets.push_back({q[0], q[1], q[2]});
            grid.surface.facets.push_back({q[0], q[2], q[3]});
          }
      }
  return grid.surface;
}

inline Surface voxels(Random& random) {
  const int n = integer(random, 2, 4);
  Grid grid(random, n, n, n, integer(random, 0, 1));
  std::set<Grid::Cell> cells;
  for (int k = 0; k < n * n * n / 2; ++k)
    cells.insert({integer(random, 0, n - 1), integer(random, 0, n - 1), integer(random, 0, n - 1)});
  return boundary_of_cells(random, grid, [&](const Grid::Cell& c) { return cells.contains(c); });
}

// Teeth up from a floor and teeth down from a ceiling that cross them at right angles, with narrow gaps.
inline Surface comb(Random& random) {
  const int teeth = integer(random, 2, 4);
  Grid grid(random, 2 * teeth + 1, 2 * teeth + 1, 5, 0.5);
  return boundary_of_cells(random, grid, [](const Grid::Cell& c) {
    if (c[2] == 0 || c[2] == 4 || (c[0] == 0 && c[1] == 0)) return true;
    if (c[2] == 1) return c[0] % 2 == 0;
    if (c[2] == 3) return c[1] % 2 == 0;
    return false;
  });
}

// Tetrahedra of a lattice (Kuhn's six a cube) fall at random into materials, 0 being outside; the facets are
// the faces between two materials. Inside, faces and edges of the lattice dangle and some of its points are
// isolated.
inline Surface lattice(Random& random) {
  const int n = integer(random, 2, 3);
  Grid grid(random, n, n, n, integer(random, 0, 2) * 0.25);
  const int materials = integer(random, 1, 3);
  std::map<Triangle, std::vector<int>> sides;  // materials on the sides of a face
  std::vector<Tetrahedron> tets;
  std::vector<int> material;
  for (int cell = 0; cell < n * n * n; ++cell) {
    std::array<std::size_t, 3> axes{0, 1, 2};
    do {
      Grid::Cell at{cell % n, cell / n % n, cell / (n * n)};
      Tetrahedron t{grid.vertex(at)};
      for (std::size_t k = 0; k < 3; ++k) {
        ++at[axes[k]];
        t[k + 1] = grid.vertex(at);
      }
      std::sort(t.begin(), t.end());
      tets.push_back(t);
      material.push_back(integer(random, 0, materials));
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (std::size_t k = 0; k < 4; ++k) {
      Triangle f{};
      for (std::size_t i = 0, j = 0; i < 4; ++i)
        if (i != k) f[j++] = tets[t][i];
      sides[f].push_back(material[t]);
    }
  Surface& s = grid.surface;
  for (auto& [f, m] : sides) {
    if (m.size() == 1) m.push_back(0);
    const bool dangles = m[0] == m[1] && m[0] != 0 && integer(random, 0, 15) == 0;
    if (m[0] != m[1] || dangles) s.facets.push_back(f);
  }
  std::set<Index> used;
  for (std::size_t t = 0; t < tets.size(); ++t)
    if (material[t] != 0) {
      used.insert(tets[t].begin(), tets[t].end());
      if (integer(random, 0, 9) == 0)
        s.segments.push_back({tets[t][0], tets[t][static_cast<std::size_t>(integer(random, 1, 3))]});
    }
  // Points of no material would be outside; those inside of one stay, isolated or not.
  std::vector<Index> rank(s.vertices.size(), 0);
  std::vector<Point> vertices;
  for (const Index v : used) {
    rank[v] = static_cast<Index>(vertices.size());
    vertices.push_back(s.vertices[v]);
  }
  s.vertices = vertices;
  for (Triangle& f : s.facets)
    for (Index& v : f) v = rank[v];
  for (Segment& e : s.segments)
    for (Index& v : e) v = rank[v];
  return s;
}

// Long triangles, segments and points, strewn in a box so that none meets another; they all dangle.
inline Surface scattered(Random& random) {
  Surface s = small::box({-1.1, -1.1, -1.1}, {1.1, 1.1, 1.1});
  const auto point = [&] {
    return Point{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
  };
  for (int k = 0; k < 60; ++k) {
    Surface more = s;
    const int kind = integer(random, 0, 4);
    const auto n = static_cast<Index>(s.vertices.size());
    if (kind == 0) more.vertices.push_back(point());
    if (kind == 1) small::add_segment(more, point(), point());
    if (kind == 2 || kind == 3) small::add_triangle(more, point(), point(), point());
    if (kind == 4) {  // on an edge of what there is
      const Triangle& f =
          s.facets[static_cast<std::size_t>(integer(random, 0, static_cast<int>(s.facets.size()) - 1))];
      more.vertices.push_back(point());
      more.facets.push_back({f[0], f[1], n});
    }
    if (diagnose(more.view(), 1).empty()) s = more;
  }
  return s;
}

// Chazelle's polyhedron (1984): notches in a box from above along x = i, from below along y = j, for i, j =
// 0..n, whose tips come as close as 1 / n^2 along the hyperbolic paraboloid z = xy.
inline Surface chazelle(int n) {
  const double gap = 1.0 / (n * n), low = -1, high = n + 1, bottom = -2.0 * n, top = 2.0 * n * n + 2;
  Surface s;
  std::map<Point, Index> index;
  const auto vertex = [&](const Point& p) {
    const auto [it, fresh] = index.try_emplace(p, static_cast<Index>(s.vertices.size()));
    if (fresh) s.vertices.push_back(p);
    return it->second;
  };
  // Mouths and tips of the notches along one side of the box; `axis` runs along the side.
  const auto row = [&](std::size_t axis, double across, double level, double slack) {
    const auto place = [&](double x, double z) {
      Point p{across, across, z};
      p[axis] = x;
      return p;
    };
    std::vector<Point> line{place(low, level)};
    for (int i = 0; i <= n; ++i) {
      const double tip = i * across + slack;
      const double width = std::abs(level - tip) / (16.0 * n * n);
      for (const Point& p : {place(i - width, level), place(i, tip), place(i + width, level)})
        line.push_back(p);
    }
    line.push_back(place(high, level));
    return line;
  };
  const auto sheet = [&](const std::vector<Point>& first, const std::vector<Point>& second) {
    for (std::size_t k = 1; k < first.size(); ++k) {
      const Index a = vertex(first[k - 1]), b = vertex(first[k]), c = vertex(second[k]),
                  d = vertex(second[k - 1]);
      s.facets.insert(s.facets.end(), {{a, b, c}, {a, c, d}});
    }
  };
  const auto wall = [&](std::vector<Point> outline, const std::vector<Point>& line, std::size_t axis) {
    outline.insert(outline.end(), line.rbegin(), line.rend());
    TetMesh plane;
    std::vector<Vertex> polygon;
    for (const Point& p : outline) polygon.push_back(MeshEditor(plane).add_vertex(p));
    Point beside = outline[0];
    beside[axis] -= 1;
    Vertex above = MeshEditor(plane).add_vertex(beside);
    if (plane.orient(0, 1, 2, above) < 0) {
      beside[axis] += 2;
      above = MeshEditor(plane).add_vertex(beside);
    }
    for (const auto& t : triangulate_polygon(plane, polygon, above))
      s.facets.push_back({vertex(outline[t[0]]), vertex(outline[t[1]]), vertex(outline[t[2]])});
  };
  sheet(row(0, low, top, gap), row(0, high, top, gap));
  sheet(row(1, low, bottom, 0), row(1, high, bottom, 0));
  for (const double y : {low, high}) wall({{low, y, bottom}, {high, y, bottom}}, row(0, y, top, gap), 1);
  for (const double x : {low, high}) wall({{x, low, top}, {x, high, top}}, row(1, x, bottom, 0), 0);
  return s;
}

}  // namespace holdfast::hard
