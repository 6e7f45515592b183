// Untangling: meshes tangled in many ways become positive with an unchanged boundary, or are refused.
#include "holdfast/untangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "hard_surfaces.h"
#include "small_surfaces.h"
#include "unit/tangled.h"
#include "untangle/connectivity.h"
#include "untangle/swap.h"

namespace holdfast::untangle_test {
namespace {

using namespace testing;

TEST(Untangle, APositiveMeshDoesNotChange) {
  Random random(1);
  const Grid g = grid(3, 0.2, random);
  const UntangleResult result = untangled(g.surface, g.volume);
  EXPECT_EQ(result.volume.vertices, g.volume.vertices);
  EXPECT_EQ(result.volume.tetrahedra, g.volume.tetrahedra);
  EXPECT_EQ(result.report.moved, 0u);
}

// Negative, then null, then quality (paper §6.4); the expectations on the boundary are those of `untangled`.
TEST(Untangle, Improves) {
  for (const double amplitude : {0.0, 0.3}) {
    Random random(3);
    Grid g = grid(4, 0.2, random, true);
    displace(g.volume, g.surface.vertices.size(), amplitude, random);
    const UntangleResult plain = untangled(g.surface, g.volume);
    UntangleOptions options;
    options.improve = true;
    const UntangleResult result = untangled(g.surface, g.volume, options);
    const auto& [before, after] = std::tie(result.report.improved.before, result.report.improved.after);
    EXPECT_EQ(before.tetrahedra, plain.volume.tetrahedra.size());
    EXPECT_EQ(after.tetrahedra, result.volume.tetrahedra.size());
    EXPECT_GT(after.min_dihedral_deg, before.min_dihedral_deg);
    EXPECT_LT(after.mean_quality, before.mean_quality);
    EXPECT_LE(after.below_10_deg, before.below_10_deg);
    EXPECT_EQ(result.volume.regions.size(), result.volume.tetrahedra.size());
    const UntangleResult again = untangled(g.surface, g.volume, options);
    EXPECT_EQ(again.volume.vertices, result.volume.vertices);
    EXPECT_EQ(again.volume.tetrahedra, result.volume.tetrahedra);
  }
}

TEST(Untangle, ImprovingKeepsFixedVertices) {
  Random random(4);
  const Grid g = grid(3, 0.4, random);
  UntangleOptions options;
  options.improve = true;
  for (std::size_t v = g.surface.vertices.size(); v < g.volume.vertices.size(); ++v)
    options.fixed.push_back(static_cast<Index>(v));
  const UntangleResult result = untangled(g.surface, g.volume, options);
  ASSERT_GE(result.volume.vertices.size(), g.volume.vertices.size());
  EXPECT_TRUE(std::equal(g.volume.vertices.begin(), g.volume.vertices.end(), result.volume.vertices.begin()));
}

TEST(Untangle, ImprovingNeedsRefill) {
  Random random(5);
  UntangleOptions options;
  options.improve = true;
  options.refill = false;
  EXPECT_THROW((void)untangle(grid(2, 0.1, random).volume, options), std::invalid_argument);
}

TEST(Untangle, DisplacedInnerVertices) {
  Random random(2);
  for (const double amplitude : {0.2, 0.5, 1.0, 3.0, 30.0, 1e6}) {
    SCOPED_TRACE(amplitude);
    Grid g = grid(5, 0.2, random);
    displace(g.volume, g.surface.vertices.size(), amplitude, random);
    EXPECT_GT(nonpositive(g.volume), 0u);
    const UntangleResult result = untangled(g.surface, g.volume);
    EXPECT_EQ(result.report.negative + result.report.null, nonpositive(g.volume));
    EXPECT_GT(result.report.moved, 0u);
  }
}

TEST(Untangle, RoundedVertices) {
  Random random(3);
  for (const double step : {0.01, 0.4, 1.1, 2.5, 100.0}) {
    SCOPED_TRACE(step);
    Grid g = grid(6, 0.3, random);
    move(g.volume.vertices, g.surface.vertices.size(), g.volume.vertices.size(), [&](const Point& p) {
      return Point{std::round(p[0] / step) * step, std::round(p[1] / step) * step,
                   std::round(p[2] / step) * step};
    });
    untangled(g.surface, g.volume);
  }
}

TEST(Untangle, ThinMeshesRoundedToSinglePrecision) {
  Random random(4);
  for (const bool everything : {false, true})
    for (const double thickness : {1e-5, 1e-6, 2e-7}) {
      SCOPED_TRACE(thickness);
      Grid g = grid(4, 0.3, random);
      const auto squash = [&](const Point& p) { return Point{p[0] + 0.1, p[1] + 0.1, 1 + thickness * p[2]}; };
      const auto round = [](const Point& p) { return Point{float(p[0]), float(p[1]), float(p[2])}; };
      const std::size_t n = g.surface.vertices.size();
      move(g.volume.vertices, 0, g.volume.vertices.size(), squash);
      move(g.volume.vertices, everything ? 0 : n, g.volume.vertices.size(), round);
      g.surface.vertices.assign(g.volume.vertices.begin(), g.volume.vertices.begin() + static_cast<long>(n));
      if (diagnose(g.surface.view(), 1).empty()) {
        untangled(g.surface, g.volume);
      } else {
        EXPECT_EQ(untangle(g.volume).outcome, Outcome::invalid_input);
      }
    }
}

TEST(Untangle, MovedBoundary) {
  Random random(5);
  for (Point (*how)(const Point&) : {twisted, bent, sheared, squeezed}) {
    Grid g = grid(6, 0.2, random, true);
    const std::size_t n = g.surface.vertices.size();
    move(g.volume.vertices, 0, n, how);
    move(g.surface.vertices, 0, n, how);
    EXPECT_GT(nonpositive(g.volume), 0u);
    untangled(g.surface, g.volume);
  }
}

TEST(Untangle, InnerVerticesThatAreNotFinite) {
  Random random(6);
  Grid g = grid(3, 0.1, random);
  g.volume.vertices.back() = {NAN, INFINITY, 0};
  g.volume.vertices[g.volume.vertices.size() - 2] = {-INFINITY, 1, 1};
  untangled(g.surface, g.volume);
}

TEST(Untangle, TetrahedraListedTheOtherWayRound) {
  Random random(7);
  Grid g = grid(3, 0.2, random);
  for (std::size_t t = 0; t < g.volume.tetrahedra.size(); t += 3)
    std::swap(g.volume.tetrahedra[t][0], g.volume.tetrahedra[t][1]);
  const UntangleResult result = untangled(g.surface, g.volume);
  EXPECT_EQ(result.report.turned, (g.volume.tetrahedra.size() + 2) / 3);
  EXPECT_EQ(result.report.negative, 0u);
  for (Tetrahedron& t : g.volume.tetrahedra) std::swap(t[1], t[2]);
  untangled(g.surface, g.volume);
}

// Meshes with hardly any free vertex: swaps and refilled cavities must suffice.
TEST(Untangle, FilledSurfacesWhoseBoundaryMoves) {
  Random random(8);
  std::size_t swapped = 0, cavities = 0;
  for (int k = 0; k < 40; ++k) {
    SCOPED_TRACE(k);
    Surface surface = hard::star(random);
    Volume volume = mesh(surface.view()).volume;
    const std::size_t n = surface.vertices.size();
    const double angle = 0.1 * k;
    move(surface.vertices, 0, n, [&](const Point& p) {
      const double a = angle * p[2];
      return Point{p[0] * std::cos(a) - p[1] * std::sin(a), p[0] * std::sin(a) + p[1] * std::cos(a), p[2]};
    });
    std::copy(surface.vertices.begin(), surface.vertices.end(), volume.vertices.begin());
    if (!diagnose(surface.view(), 1).empty()) continue;
    const UntangleResult result = untangled(surface, volume);
    swapped += result.report.swapped;
    cavities += result.report.cavities;
  }
  EXPECT_GT(swapped, 0u);
  EXPECT_GT(cavities, 0u);
}

TEST(Untangle, SegmentsAndFixedVerticesStay) {
  Random random(9);
  Grid g = grid(4, 0.1, random);
  const auto n = static_cast<Index>(g.surface.vertices.size());
  // Two inner edges as segments, an inner vertex to keep.
  std::set<Segment> inner;
  for (const Tetrahedron& t : g.volume.tetrahedra)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (t[i] >= n && t[k] >= n) inner.insert({std::min(t[i], t[k]), std::max(t[i], t[k])});
  g.volume.segments = {*inner.begin(), *inner.rbegin()};
  g.volume.segment_markers = {3, 4};
  for (std::size_t v = 0; v < g.volume.vertices.size(); ++v)
    g.volume.vertex_markers.push_back(static_cast<int>(v % 5));
  UntangleOptions options;
  options.fixed = {n + 13};
  std::set<Index> fixed{n + 13};
  for (const Segment& s : g.volume.segments) fixed.insert(s.begin(), s.end());
  const Volume before = g.volume;
  displace(g.volume, n, 2, random);
  for (const Index v : fixed) g.volume.vertices[v] = before.vertices[v];
  const UntangleResult result = untangle(g.volume, options);
  ASSERT_EQ(result.outcome, Outcome::done) << result.message;
  EXPECT_EQ(nonpositive(result.volume), 0u);
  EXPECT_EQ(result.volume.segments, before.segments);
  EXPECT_EQ(result.volume.segment_markers, before.segment_markers);
  EXPECT_EQ(result.volume.vertex_markers.size(), result.volume.vertices.size());
  for (const Triangle& f : result.volume.facets)
    for (const Index v : f) EXPECT_EQ(result.volume.vertex_markers[v], before.vertex_markers[v]);
  for (Index v = 0; v < n; ++v) EXPECT_EQ(result.volume.vertices[v], before.vertices[v]);
  for (const Index v : fixed) EXPECT_EQ(result.volume.vertices[v], before.vertices[v]);
}

TEST(Untangle, ABoundaryThatMeetsItselfIsRefused) {
  Random random(10);
  Grid g = grid(3, 0.1, random);
  g.volume.vertices[0] = {2.5, 2.7, 4};  // a corner moved through the opposite side
  const UntangleResult result = untangle(g.volume);
  EXPECT_EQ(result.outcome, Outcome::invalid_input);
  ASSERT_FALSE(result.defects.empty());
  EXPECT_TRUE(result.volume.tetrahedra.empty());
  for (const Defect& defect : result.defects) {
    for (const Index f : defect.facets) EXPECT_LT(f, g.volume.facets.size());
    EXPECT_FALSE(defect.facets.empty() && defect.vertices.empty());
  }
}

// The boundary is a valid surface, but not the boundary of any mesh: a cavity outside of its part; a box
// within another; a box turned inside out.
TEST(Untangle, ABoundaryInTheWrongPlaceIsRefused) {
  Surface surface = small::nested(false);
  Options keep;
  keep.keep = Keep::winding;
  const Result filled = mesh(surface.view(), keep);
  ASSERT_EQ(filled.outcome, Outcome::done);
  Volume volume = filled.volume;
  for (Index v = 8; v < 16; ++v) volume.vertices[v][0] += 5;
  UntangleResult result = untangle(volume);
  EXPECT_EQ(result.outcome, Outcome::invalid_input) << result.message;
  EXPECT_FALSE(result.message.empty());

  Surface apart = small::box();
  small::add_box(apart, {3, 0, 0}, {3.5, 0.5, 0.5});
  volume = mesh(apart.view()).volume;
  for (Index v = 8; v < 16; ++v)
    for (double& x : volume.vertices[v]) x = 0.25 + x - (&x == volume.vertices[v].data() ? 3 : 0);
  result = untangle(volume);
  EXPECT_EQ(result.outcome, Outcome::invalid_input) << result.message;
}

// A segment, or a vertex that is to stay, lies outside the boundary, where no tetrahedron can be.
TEST(Untangle, ConstraintsOutsideTheBoundaryAreRefused) {
  const Surface surface = small::box();
  Volume volume;
  volume.vertices = surface.vertices;
  volume.vertices.push_back({3, 0.4, 0.6});  // was in the middle, joined to all triangles
  for (const Triangle& f : surface.facets) volume.tetrahedra.push_back({f[1], f[0], f[2], 8});
  UntangleOptions options;
  EXPECT_EQ(untangle(volume, options).outcome, Outcome::done);
  options.fixed = {8};
  const UntangleResult fixed = untangle(volume, options);
  EXPECT_EQ(fixed.outcome, Outcome::invalid_input);
  EXPECT_NE(fixed.message.find("outside"), std::string::npos) << fixed.message;
  volume.segments = {{1, 8}};
  const UntangleResult joined = untangle(volume);
  EXPECT_EQ(joined.outcome, Outcome::invalid_input);
  EXPECT_NE(joined.message.find("outside"), std::string::npos) << joined.message;
}

TEST(Untangle, ConnectivityThatIsNotAMeshIsRefused) {
  Random random(11);
  const Grid g = grid(2, 0.1, random);
  const auto refused = [](const Volume& volume, const std::string& word) {
    const UntangleResult result = untangle(volume);
    EXPECT_EQ(result.outcome, Outcome::invalid_input);
    EXPECT_NE(result.message.find(word), std::string::npos) << result.message;
  };
  Volume v = g.volume;
  v.tetrahedra.push_back(v.tetrahedra[0]);
  v.regions.push_back(1);
  refused(v, "tetrahedra");
  v = g.volume;
  v.tetrahedra[3][1] = 1000;
  refused(v, "1000");
  v = g.volume;
  v.tetrahedra[3][1] = v.tetrahedra[3][0];
  refused(v, "twice");
  v = g.volume;
  v.facets[0] = {0, 25, 26};  // two corners of the grid and the middle
  refused(v, "triangle 0");
  v = g.volume;
  v.segments = {{0, 25}};
  refused(v, "segment");
  refused(Volume{}, "no tetrahedra");
  v = g.volume;  // besides, five tetrahedra that bound a simplex of four dimensions
  for (const double k : {0.1, 0.2, 0.3, 0.4, 0.5}) v.vertices.push_back({1 + k, 1 + k * k, 1 + k * k * k});
  for (const Tetrahedron& t : {Tetrahedron{27, 28, 29, 30},
                               {27, 28, 29, 31},
                               {27, 28, 30, 31},
                               {27, 29, 30, 31},
                               {28, 29, 30, 31}}) {
    v.tetrahedra.push_back(t);
    v.regions.push_back(1);
  }
  refused(v, "not that of this mesh");
  v = g.volume;
  v.regions.pop_back();
  EXPECT_THROW(static_cast<void>(untangle(v)), std::invalid_argument);
}

TEST(Untangle, LimitsAndCancellation) {
  Random random(12);
  Grid g = grid(8, 0.2, random);
  displace(g.volume, g.surface.vertices.size(), 2, random);
  UntangleOptions options;
  options.time_limit = 1e-9;
  EXPECT_EQ(untangle(g.volume, options).outcome, Outcome::time_limit);
  options = {};
  options.memory_limit = 1;
  EXPECT_EQ(untangle(g.volume, options).outcome, Outcome::memory_limit);
  options = {};
  std::set<UntangleStep> steps;
  options.progress = [&](const UntangleProgress& progress) {
    steps.insert(progress.step);
    return progress.step != UntangleStep::relocate;
  };
  const UntangleResult result = untangle(g.volume, options);
  EXPECT_EQ(result.outcome, Outcome::cancelled);
  EXPECT_TRUE(result.volume.tetrahedra.empty());
  EXPECT_TRUE(steps.contains(UntangleStep::validate));
}

TEST(Untangle, TheSameResultTwice) {
  Random random(13);
  Grid g = grid(5, 0.2, random);
  displace(g.volume, g.surface.vertices.size(), 3, random);
  const UntangleResult a = untangle(g.volume), b = untangle(g.volume);
  EXPECT_EQ(a.volume.vertices, b.volume.vertices);
  EXPECT_EQ(a.volume.tetrahedra, b.volume.tetrahedra);
}

TEST(Untangle, NoDoublesInside) {
  // The polyhedron of docs/concepts.md, What cannot be guaranteed, with a vertex inside at first, far from
  // the origin: no integer point is inside.
  const Surface near = small::without_integer_points(0);
  const Result filled = mesh(near.view());
  ASSERT_EQ(filled.outcome, Outcome::done);
  Volume volume = filled.volume;
  const Surface far = small::without_integer_points(0x1p52);
  std::copy(far.vertices.begin(), far.vertices.end(), volume.vertices.begin());
  for (std::size_t v = far.vertices.size(); v < volume.vertices.size(); ++v)
    for (double& x : volume.vertices[v]) x += 0x1p52;
  const UntangleResult result = untangle(volume);
  EXPECT_EQ(result.outcome, Outcome::not_representable) << result.message;
  EXPECT_GT(result.report.negative_after + result.report.null_after, 0u);
}

}  // namespace
}  // namespace holdfast::untangle_test
