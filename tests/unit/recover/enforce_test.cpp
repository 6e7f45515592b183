// Partition and elimination: every constraint exists, covered exactly; nothing else is on it; the volume is
// unchanged.
#include "enforce/enforce.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hard_surfaces.h"
#include "mesh/validate.h"
#include "mesh_fixtures.h"
#include "small_surfaces.h"
#include "unit/enforced.h"

namespace holdfast::enforce_test {
namespace {

using namespace testing;
// --- all of it

Surface schoenhardt(double twist, double height) {
  Surface s;
  for (int k = 0; k < 6; ++k) {
    const double angle = 2 * hard::kPi / 3 * (k % 3) + (k < 3 ? 0 : twist);
    s.vertices.push_back({std::cos(angle), std::sin(angle), k < 3 ? 0 : height});
  }
  s.facets = small::prism_facets({0, 2, 1}, {3, 4, 5});
  return s;
}

std::vector<Surface> hard_ones() {
  std::vector<Surface> out;
  for (const double height : {0.2, 1.0, 5.0})
    for (int k = 1; k < 10; ++k) out.push_back(schoenhardt(k * hard::kPi / 30, height));
  Random random(1);
  for (int k = 0; k < 5; ++k) out.push_back(hard::twisted_prism(random));
  for (int n = 1; n <= 3; ++n) out.push_back(hard::chazelle(n));
  for (int k = 0; k <= 6; ++k) out.push_back(pages(k, 10 + static_cast<std::uint64_t>(k)));
  for (int k = 0; k < 2; ++k) out.push_back(hard::scattered(random));
  return out;
}

TEST(Enforce, WithoutEliminationLaysAllOnPartitionPoints) {
  std::size_t on_segments = 0, in_facets = 0;
  for (const Surface& surface : hard_ones()) {
    Task t = task(surface);
    const EnforceStats stats = run(t, {.seed = 3, .eliminate = false});
    EXPECT_EQ(t.mesh.vertex_count() - t.first_free, stats.segment_points + stats.facet_points);
    EXPECT_EQ(t.standing.missing_facets(), 0u);
    expect_laid(t);
    on_segments += stats.segment_points;
    in_facets += stats.facet_points;
  }
  EXPECT_GT(on_segments, 100u);
  EXPECT_GT(in_facets, 100u);
}

void expect_enforcement(const Surface& surface, const std::vector<Point>& steiner = {}) {
  for (const bool flips : {false, true})
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      Task t = task(surface, steiner);
      run(t, {.seed = seed, .flips = flips});
      EXPECT_EQ(t.standing.missing_segments() + t.standing.missing_facets(), 0u);
      expect_enforced(t);
    }
}

TEST(Enforce, MakesEveryConstraintStand) {
  for (const Surface& surface : hard_ones()) expect_enforcement(surface);
}

TEST(Enforce, TheSeedAloneDecides) {
  Task one = task(hard::chazelle(2)), same = one, other = one;
  run(one, {.seed = 1, .flips = false});
  run(same, {.seed = 1, .flips = false});
  run(other, {.seed = 2, .flips = false});
  EXPECT_EQ(difference(one.mesh, same.mesh), "");
  EXPECT_NE(difference(one.mesh, other.mesh), "");
}

// Points that were moved off one constraint and accidentally onto others that are missing.
TEST(Enforce, TakesSteinerPointsOffMissingConstraints) {
  Surface surface = facet_task(3, false).surface;
  for (Index above = 3; surface.segments.empty(); ++above)
    for (Index v = 3; v < above && surface.segments.empty(); ++v)
      if (surface.vertices[v][2] > 0.5 && surface.vertices[above][2] > 0.5) surface.segments = {{v, above}};
  expect_enforcement(surface, {{0, 0, 0.125}, {0.25, 0.25, 0.125}, {0, 0.625, 0.125}, {0.5, 0.5, 0.125}});
  Surface prism = schoenhardt(0.5, 2);
  for (Point& p : prism.vertices)
    for (double& x : p) x = std::round(16 * x) / 16;
  std::vector<Point> steiner;
  for (const auto& [a, b, c] : prism.facets)
    for (const std::array<double, 3>& w : {std::array{0.5, 0.25, 0.25}, std::array{0.5, 0.5, 0.0}}) {
      Point p{};
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = w[0] * prism.vertices[a][k] + w[1] * prism.vertices[b][k] + w[2] * prism.vertices[c][k];
      if (std::find(steiner.begin(), steiner.end(), p) == steiner.end()) steiner.push_back(p);
    }
  expect_enforcement(prism, steiner);
}

TEST(Enforce, StopsWhenToldToWithAValidMesh) {
  Task t = task(hard::chazelle(2));
  Options options;
  options.time_limit = 1e-9;
  Monitor monitor(options);
  EXPECT_THROW(
      enforce(t.mesh, {t.table, t.surface.facets, t.standing}, t.first_free, {.flips = false}, monitor),
      Interrupted);
  EXPECT_EQ(find_fault(t.mesh), "");
  EXPECT_EQ(volume_of(t.mesh), t.volume);
}

}  // namespace
}  // namespace holdfast::enforce_test
