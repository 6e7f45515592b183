// Meshes to tangle, ways to tangle them, and the conditions on the result.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "exact/predicates.h"
#include "holdfast/check.h"
#include "holdfast/untangle.h"
#include "small_surfaces.h"

namespace holdfast::testing {

using Random = std::mt19937_64;

// --- meshes

// A grid of n^3 unit cells, 6 tetrahedra each; vertices of the surface first, inner ones jittered. Two
// regions, x < n/2 and x > n/2, if `halves`.
struct Grid {
  Surface surface;
  Volume volume;
};

inline Grid grid(int n, double jitter, Random& random, bool halves = false) {
  const auto at_surface = [&](std::array<int, 3> c) {
    const bool wall = halves && 2 * c[0] == n;
    return wall || std::any_of(c.begin(), c.end(), [&](int x) { return x == 0 || x == n; });
  };
  Grid out;
  std::map<std::array<int, 3>, Index> index;
  std::uniform_real_distribution<double> u(-jitter, jitter);
  for (const bool surface : {true, false})
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j)
        for (int k = 0; k <= n; ++k) {
          if (at_surface({i, j, k}) != surface) continue;
          index[{i, j, k}] = static_cast<Index>(out.volume.vertices.size());
          Point p{double(i), double(j), double(k)};
          if (surface) out.surface.vertices.push_back(p);
          if (!surface)
            for (double& x : p) x += u(random);
          out.volume.vertices.push_back(p);
        }
  std::map<Triangle, std::vector<int>> faces;
  std::array<int, 3> axes{0, 1, 2};
  for (int cell = 0; cell < n * n * n; ++cell) {
    const std::array<int, 3> low{cell / (n * n), cell / n % n, cell % n};
    do {
      std::array<int, 3> at = low;
      Tetrahedron t{index[at], 0, 0, 0};
      for (std::size_t k = 0; k < 3; ++k) {
        ++at[static_cast<std::size_t>(axes[k])];
        t[k + 1] = index[at];
      }
      const bool odd = ((axes[0] > axes[1]) != (axes[1] > axes[2])) != (axes[0] > axes[2]);
      if (odd) std::swap(t[2], t[3]);
      out.volume.tetrahedra.push_back(t);
      out.volume.regions.push_back(halves && 2 * low[0] >= n ? 2 : 1);
      for (std::size_t k = 0; k < 4; ++k) {
        Triangle f{t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]};
        std::sort(f.begin(), f.end());
        faces[f].push_back(out.volume.regions.back());
      }
    } while (std::next_permutation(axes.begin(), axes.end()));
    axes = {0, 1, 2};
  }
  for (const auto& [face, regions] : faces)
    if (regions.size() == 1 || regions[0] != regions[1]) out.surface.facets.push_back(face);
  out.volume.facets = out.surface.facets;
  for (std::size_t f = 0; f < out.volume.facets.size(); ++f)
    out.volume.facet_markers.push_back(static_cast<int>(f % 7));
  out.surface.facet_markers = out.volume.facet_markers;
  return out;
}

// --- conditions on a result

inline std::size_t nonpositive(const Volume& volume) {
  const auto p = [&](Index v) { return volume.vertices[v].data(); };
  return static_cast<std::size_t>(std::count_if(
      volume.tetrahedra.begin(), volume.tetrahedra.end(),
      [&](const Tetrahedron& t) { return exact::orient3d(p(t[0]), p(t[1]), p(t[2]), p(t[3])) <= 0; }));
}

inline void expect_promise(const Complex& surface, const Volume& volume) {
  for (const Rule& rule : check(surface, volume).rules)
    EXPECT_TRUE(rule.holds) << rule.name << ": " << rule.detail;
}

UntangleResult untangled(const Surface& surface, const Volume& volume, const UntangleOptions& options = {}) {
  UntangleResult result = untangle(volume, options);
  EXPECT_EQ(result.outcome, Outcome::done) << result.message;
  if (result.outcome == Outcome::done) {
    expect_promise(surface.view(), result.volume);
    EXPECT_EQ(result.volume.facets, volume.facets);
    EXPECT_EQ(result.volume.facet_markers, volume.facet_markers);
    EXPECT_EQ(result.report.negative_after + result.report.null_after, 0u);
  }
  return result;
}

// --- ways to tangle

inline void displace(Volume& volume, std::size_t fixed, double amplitude, Random& random) {
  std::normal_distribution<double> normal(0, amplitude);
  for (std::size_t v = fixed; v < volume.vertices.size(); ++v)
    for (double& x : volume.vertices[v]) x += normal(random);
}

template <typename Move>
inline void move(std::vector<Point>& points, std::size_t from, std::size_t to, Move how) {
  for (std::size_t v = from; v < to; ++v) points[v] = how(points[v]);
}

inline Point twisted(const Point& p) {
  const double a = 0.4 * p[2], x = p[0] - 3, y = p[1] - 3;
  return {3 + x * std::cos(a) - y * std::sin(a), 3 + x * std::sin(a) + y * std::cos(a), p[2]};
}
inline Point bent(const Point& p) {
  const double a = 0.3 * p[0], r = 5 + p[2];
  return {r * std::sin(a), p[1], r * std::cos(a)};
}
inline Point sheared(const Point& p) { return {p[0] + 1.5 * p[2], p[1], p[2]}; }
inline Point squeezed(const Point& p) {
  return {p[0], 3 + (p[1] - 3) * (0.1 + 0.15 * p[0]), 3 + (p[2] - 3) * (0.1 + 0.3 * p[0])};
}

}  // namespace holdfast::testing
