// Several elements across walls and gaps (refine/layers.h), and the report of a mesh (api/condition.h).
#include "refine/layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <set>

#include "checked_mesh.h"
#include "hard_surfaces.h"
#include "holdfast/holdfast.h"
#include "numbers/vector.h"
#include "small_surfaces.h"

namespace holdfast::layers_test {
namespace {

using testing::mesh_with;

// A slab with n x n squares on either side, and one row of them around it.
Surface slab(int n, double thickness) {
  Surface s;
  const auto at = [&](int i, int j, int k) { return static_cast<Index>((i * (n + 1) + j) * 2 + k); };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      for (const double z : {0.0, thickness})
        s.vertices.push_back({i / static_cast<double>(n), j / static_cast<double>(n), z});
  const auto quad = [&](Index a, Index b, Index c, Index d) {
    s.facets.push_back({a, b, c});
    s.facets.push_back({a, c, d});
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      quad(at(i, j, 0), at(i, j + 1, 0), at(i + 1, j + 1, 0), at(i + 1, j, 0));
      quad(at(i, j, 1), at(i + 1, j, 1), at(i + 1, j + 1, 1), at(i, j + 1, 1));
    }
    quad(at(i, 0, 0), at(i + 1, 0, 0), at(i + 1, 0, 1), at(i, 0, 1));
    quad(at(i, n, 0), at(i, n, 1), at(i + 1, n, 1), at(i + 1, n, 0));
    quad(at(0, i, 0), at(0, i, 1), at(0, i + 1, 1), at(0, i + 1, 0));
    quad(at(n, i, 0), at(n, i + 1, 0), at(n, i + 1, 1), at(n, i, 1));
  }
  return s;
}

// The least number of edges on a path from one side to the other whose inner vertices and edges are not on
// the surface.
int edges_across(const Volume& volume, const std::function<int(const Point&)>& side_of, std::size_t surface) {
  std::set<std::array<Index, 2>> on_facets;
  for (const Triangle& f : volume.facets)
    for (std::size_t k = 0; k < 3; ++k)
      on_facets.insert({std::min(f[k], f[(k + 1) % 3]), std::max(f[k], f[(k + 1) % 3])});
  std::vector<std::set<Index>> next(volume.vertices.size());
  for (const Tetrahedron& t : volume.tetrahedra)
    for (const Index a : t)
      for (const Index b : t)
        if (a != b && !on_facets.contains({std::min(a, b), std::max(a, b)})) next[a].insert(b);
  std::vector<int> distance(volume.vertices.size(), -1);
  std::deque<Index> queue;
  for (Index v = 0; v < surface; ++v)
    if (side_of(volume.vertices[v]) < 0) {
      distance[v] = 0;
      queue.push_back(v);
    }
  while (!queue.empty()) {
    const Index v = queue.front();
    queue.pop_front();
    for (const Index w : next[v]) {
      if (distance[w] >= 0) continue;
      distance[w] = distance[v] + 1;
      if (side_of(volume.vertices[w]) > 0) return distance[w];
      if (w >= surface) queue.push_back(w);
    }
  }
  return std::numeric_limits<int>::max();
}

TEST(Layers, AcrossASlab) {
  const double thickness = 0.04;
  const Surface surface = slab(8, thickness);
  const auto is_inner = [](double x) { return 0 < x && x < 1; };
  const auto side_of = [&](const Point& p) {
    return !is_inner(p[0]) || !is_inner(p[1]) ? 0 : p[2] == 0 ? -1 : p[2] == thickness ? 1 : 0;
  };
  for (const unsigned layers : {1u, 2u, 3u, 5u}) {
    const Result result = mesh_with(surface, {.layers = layers});
    EXPECT_EQ(result.report.layers.left, 0u) << layers;
    EXPECT_GE(edges_across(result.volume, side_of, surface.vertices.size()), static_cast<int>(layers))
        << layers;
    EXPECT_EQ(result.report.layers.points > 0, layers > 1) << layers;
    EXPECT_EQ(result.report.layers.at_rims, layers > 1 ? 64u : 0u) << layers;
  }
}

// A cube from `low` to `high` with n x n squares a side, turned inside out unless `outwards`.
void add_cube(Surface& s, double low, double high, int n, bool outwards) {
  std::map<std::array<int, 3>, Index> index;
  const auto at = [&](std::array<int, 3> place) {
    const auto [found, is_new] = index.try_emplace(place, static_cast<Index>(s.vertices.size()));
    if (is_new) {
      Point p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = low + (high - low) * place[k] / n;
      s.vertices.push_back(p);
    }
    return found->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> place{};
            place[axis] = side;
            place[(axis + 1) % 3] = i + di;
            place[(axis + 2) % 3] = j + dj;
            return at(place);
          };
          const Index a = corner(0, 0), c = corner(1, 1);
          const bool turned = (side == 0) == outwards;
          const Index b = turned ? corner(0, 1) : corner(1, 0), d = turned ? corner(1, 0) : corner(0, 1);
          s.facets.push_back({a, b, c});
          s.facets.push_back({a, c, d});
        }
}

TEST(Layers, AcrossTheGapBetweenTwoCubes) {
  constexpr double kLow = 0.04;
  Surface surface;
  add_cube(surface, 0, 1, 6, true);
  add_cube(surface, kLow, 1 - kLow, 6, false);
  const Result result = mesh_with(surface, {.layers = 3});
  EXPECT_EQ(result.report.layers.left, 0u);
  EXPECT_EQ(result.report.layers.at_rims, 0u);
  EXPECT_GT(result.report.layers.points, 0u);
  for (const std::size_t k : {0u, 1u, 2u}) {
    const auto side_of = [&](const Point& p) { return p[k] == 0 ? -1 : p[k] == kLow ? 1 : 0; };
    EXPECT_GE(edges_across(result.volume, side_of, surface.vertices.size()), 3) << k;
  }
}

TEST(Layers, TooManyAreRefused) {
  Options options;
  options.sizes = Sizes{.layers = 101};
  const Surface box = small::box();
  EXPECT_THROW((void)mesh(box.view(), options), std::invalid_argument);
}

}  // namespace
}  // namespace holdfast::layers_test
