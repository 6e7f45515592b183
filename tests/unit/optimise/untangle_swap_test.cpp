// Untangling if moving vertices does not suffice: swaps keep a manifold, cavities are filled again.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "holdfast/untangle.h"
#include "small_surfaces.h"
#include "unit/tangled.h"
#include "untangle/connectivity.h"
#include "untangle/refill_cavity.h"
#include "untangle/swap.h"

namespace holdfast::untangle_swap_test {
namespace {

using namespace testing;

// Two tetrahedra on a triangle whose apexes see each other past it: no vertex is free, and the same boundary
// has a mesh of three tetrahedra round the edge between the apexes, or vice versa.
TEST(Untangle, SwapsIfNoVertexMayMove) {
  // abc with d above and e below; e is displaced so that the edge de passes outside abc.
  Volume volume;
  volume.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, 1}, {0.5, 0.5, -1}};
  volume.tetrahedra = {{0, 1, 4, 3}, {1, 2, 4, 3}, {2, 0, 4, 3}};
  ASSERT_EQ(nonpositive(volume), 0u);
  volume.vertices[4] = {3, 3, -1};  // de leaves abc
  ASSERT_EQ(nonpositive(volume), 1u);
  UntangleOptions options;
  options.refill = false;
  const UntangleResult result = untangle(volume, options);
  ASSERT_EQ(result.outcome, Outcome::done) << result.message;
  EXPECT_EQ(result.volume.vertices, volume.vertices);
  EXPECT_EQ(result.volume.tetrahedra.size(), 2u);
  EXPECT_EQ(nonpositive(result.volume), 0u);
  EXPECT_EQ(result.report.swapped, 1u);
  EXPECT_EQ(result.report.moved, 0u);
}

// Schönhardt's prism as three tetrahedra, which fill the prism before it is twisted: it cannot be meshed
// without a new vertex.
TEST(Untangle, AddsAVertexIfNothingElseHelps) {
  const auto prism = [](double twist) {
    std::vector<Point> points;
    for (int k = 0; k < 6; ++k) {
      const double angle = 2 * std::acos(-1.0) / 3 * (k % 3) + (k < 3 ? 0 : twist);
      points.push_back({std::cos(angle), std::sin(angle), k < 3 ? 0.0 : 2.0});
    }
    return points;
  };
  Surface surface;
  surface.vertices = prism(0.5);
  surface.facets = small::prism_facets({0, 2, 1}, {3, 4, 5});
  // A vertex in the middle joined to all facets, then displaced far outside.
  Volume volume;
  volume.vertices = surface.vertices;
  volume.vertices.push_back({0, 0, 1});
  for (const Triangle& f : surface.facets) volume.tetrahedra.push_back({f[0], f[2], f[1], 6});
  volume.facets = surface.facets;
  volume.regions.assign(volume.tetrahedra.size(), 4);
  volume.vertices[6] = {10, 0, 1};
  const UntangleResult moved = untangled(surface, volume);
  EXPECT_EQ(moved.volume.vertices.size(), 7u);
  EXPECT_EQ(moved.volume.regions, std::vector<int>(moved.volume.tetrahedra.size(), 4));
}

// The star of v as the tetrahedra's faces opposite it: V - E + F, which is 2 for a sphere and 1 for a disc.
// Less than 0 where an edge is in more than two of the faces.
int euler_of_link(const Tangle& tangle, Vertex v) {
  std::set<Vertex> vertices;
  std::map<std::array<Vertex, 2>, int> edges;
  for (const Tet t : tangle.star(v)) {
    const auto f = tangle.face(t, tangle.index_of(t, v));
    vertices.insert(f.begin(), f.end());
    for (std::size_t i = 0; i < 3; ++i)
      if (++edges[ascending(std::array{f[i], f[(i + 1) % 3]})] > 2) return -1;
  }
  return static_cast<int>(vertices.size() + tangle.star(v).size()) - static_cast<int>(edges.size());
}

// The number of tetrahedra connected with the first by faces.
std::size_t reached(const Tangle& tangle) {
  std::set<Tet> met;
  std::vector<Tet> queue{tangle.star(0)[0]};
  while (!queue.empty()) {
    const Tet t = queue.back();
    queue.pop_back();
    if (t == kNone || !met.insert(t).second) continue;
    for (int i = 0; i < 4; ++i) queue.push_back(tangle.across(t, i));
  }
  return met.size();
}

TEST(Untangle, SwapsKeepAManifold) {
  Random random(15);
  const Options options;
  Monitor monitor(options);
  Watch watch(monitor);
  std::size_t swaps = 0;
  for (const double amplitude : {0.3, 1.0, 5.0}) {
    Grid g = grid(5, 0.2, random);
    displace(g.volume, 0, amplitude, random);
    const Connectivity connectivity = read_connectivity(g.volume, {});
    Tangle tangle(g.volume.vertices, connectivity.tets, connectivity.regions, connectivity.constraints);
    while (const std::size_t more = swap_tets(tangle, watch)) swaps += more;
    EXPECT_EQ(reached(tangle), tangle.tet_count());
    for (const auto& f : connectivity.constraints.faces) EXPECT_TRUE(tangle.has_face(f[0], f[1], f[2]));
    for (Vertex v = 0; v < tangle.vertex_count(); ++v)
      EXPECT_EQ(euler_of_link(tangle, v), v < g.surface.vertices.size() ? 1 : 2) << v;
  }
  EXPECT_GT(swaps, 500u);
}

// A tetrahedron with a vertex inside, as four; they lie next to the grid that they belong to, inverted.
// The boundary of all others, the cavity, is a valid surface and is seen from the right side everywhere, but
// it bounds two parts of space: filled, the second would close the four off, with no boundary left.
TEST(Untangle, ACavityStaysConnected) {
  Random random(14);
  Grid g = grid(3, 0, random);
  const auto n = static_cast<Index>(g.surface.vertices.size()), middle = n + 8;
  move(g.volume.vertices, n, middle, [](const Point& p) { return Point{10 - p[0], p[1], p[2]}; });
  std::vector<Tetrahedron>& tets = g.volume.tetrahedra;
  const auto at = std::ranges::find_if(tets, [n](const Tetrahedron& t) { return std::ranges::min(t) >= n; });
  const Tetrahedron inner = *at;
  Point& centre = g.volume.vertices.emplace_back();
  for (const Index v : inner)
    for (std::size_t k = 0; k < 3; ++k) centre[k] += g.volume.vertices[v][k] / 4;
  tets.erase(at);
  for (const std::size_t i : {0u, 1u, 2u, 3u}) (tets.emplace_back(inner))[i] = middle;
  g.volume.regions.assign(tets.size(), 1);

  const Connectivity connectivity = read_connectivity(g.volume, {});
  ASSERT_EQ(connectivity.fault, "");
  const Tangle tangle(g.volume.vertices, connectivity.tets, connectivity.regions, connectivity.constraints);
  std::vector<Tet> all(tets.size());
  std::iota(all.begin(), all.end(), Tet{0});
  const std::vector<Tet> cavity(all.begin(), all.end() - 4);
  for (Tet t = 0; t < all.size(); ++t) ASSERT_EQ(tangle.holds(t, middle), t >= cavity.size());
  const CavityFiller filler = [](const Complex& complex) {
    Options options;
    options.keep = Keep::bounded;
    options.drop_outside = true;
    Result result = mesh(complex, options);
    EXPECT_EQ(result.outcome, Outcome::done);
    return Filled{.volume = std::move(result.volume)};
  };
  EXPECT_EQ(RefillCavity(tangle, cavity).fill(filler), RefillCavity::Outcome::invalid);
  EXPECT_EQ(RefillCavity(tangle, all).fill(filler), RefillCavity::Outcome::filled);
}

}  // namespace
}  // namespace holdfast::untangle_swap_test
