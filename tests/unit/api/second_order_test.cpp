// Elements of second order: where their Jacobian is positive, nodes on a smooth surface, and the rules of
// check.
#include "holdfast/second_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "exact/jacobian.h"
#include "holdfast/check.h"
#include "holdfast/holdfast.h"
#include "numbers/random.h"
#include "second_order/edges_of.h"
#include "small_surfaces.h"
#include "surface/nearest.h"

namespace holdfast::second_order_test {
namespace {

using exact::Jacobian;
using Nodes = std::array<Point, 10>;

Nodes straight(const std::array<Point, 4>& corners) {
  Nodes nodes;
  for (std::size_t i = 0; i < 4; ++i) nodes[i] = corners[i];
  for (std::size_t e = 0; e < 6; ++e)
    nodes[4 + e] = middle(corners[kTetrahedronEdges[e][0]], corners[kTetrahedronEdges[e][1]]);
  return nodes;
}

const std::array<Point, 4> kUnit{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

// By the shape functions, as a finite-element program does it.
double jacobian_at(const Nodes& nodes, const std::array<double, 4>& l) {
  std::array<std::array<double, 3>, 3> j{};
  constexpr double kGradient[4][3] = {{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto add = [&](const Point& node, std::size_t corner, double factor) {
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 3; ++c) j[k][c] += factor * kGradient[corner][c] * node[k];
  };
  for (std::size_t i = 0; i < 4; ++i) add(nodes[i], i, 4 * l[i] - 1);
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [a, b] = kTetrahedronEdges[e];
    add(nodes[4 + e], a, 4 * l[b]);
    add(nodes[4 + e], b, 4 * l[a]);
  }
  return j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
         j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
         j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
}

TEST(JacobianOfElement, StraightOnesHaveTheSignOfTheirVolume) {
  EXPECT_EQ(exact::jacobian_of(straight(kUnit)), Jacobian::positive);
  std::array<Point, 4> turned = kUnit;
  std::swap(turned[0], turned[1]);
  EXPECT_EQ(exact::jacobian_of(straight(turned)), Jacobian::not_positive);
  std::array<Point, 4> flat = kUnit;
  flat[3] = {0.25, 0.25, 0};
  EXPECT_EQ(exact::jacobian_of(straight(flat)), Jacobian::not_positive);
  std::array<Point, 4> thin = kUnit;
  thin[3] = {0.25, 0.25, 0x1p-60};
  EXPECT_EQ(exact::jacobian_of(straight(thin)), Jacobian::positive) << "decided exactly";
}

// The node of one edge moves along it: at the quarter point the Jacobian is zero at the corner.
Volume one_element(const std::array<Point, 4>& corners) {
  Volume volume;
  volume.vertices.assign(corners.begin(), corners.end());
  volume.tetrahedra = {{0, 1, 2, 3}};
  volume.regions = {1};
  add_mid_nodes(volume);
  return volume;
}

/// A bound in doubles decides most elements; near the bound all of them agree with the exact decision.
TEST(NotPositiveElements, AreThoseOfTheExactDecision) {
  numbers::Random random(5);
  std::size_t positive = 0, turned = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    std::array<Point, 4> corners{};
    for (Point& p : corners)
      for (double& x : p) x = 1 + static_cast<double>(numbers::below(1 << 20, random)) * 0x1p-20;
    // The last vertex is some last bits above the plane of the others.
    const double s = static_cast<double>(numbers::below(1 << 10, random)) * 0x1p-11;
    for (std::size_t k = 0; k < 3; ++k)
      corners[3][k] = corners[0][k] + s * (corners[1][k] - corners[0][k]) +
                      (0.5 - s / 2) * (corners[2][k] - corners[0][k]) +
                      static_cast<double>(numbers::below(64, random)) * 0x1p-52;
    for (const int exponent : {0, 40, -1000}) {
      std::array<Point, 4> scaled = corners;
      for (Point& p : scaled)
        for (double& x : p) x = std::ldexp(x, exponent);
      const Volume volume = one_element(scaled);
      const bool is_positive = exact::jacobian_of(straight(scaled)) == Jacobian::positive;
      EXPECT_EQ(not_positive_elements(volume).empty(), is_positive);
      (is_positive ? positive : turned) += 1;
    }
  }
  EXPECT_GT(positive, 100u);
  EXPECT_GT(turned, 100u);
}

TEST(NotPositiveElements, OfFirstOrderAreNone) {
  Volume volume = one_element(kUnit);
  EXPECT_TRUE(not_positive_elements(volume).empty());
  volume.tetrahedra = {{1, 0, 2, 3}};
  add_mid_nodes(volume);
  EXPECT_EQ(not_positive_elements(volume), std::vector<Index>{0});
  volume.mid_nodes = {};
  EXPECT_TRUE(not_positive_elements(volume).empty());
}

TEST(JacobianOfElement, VanishesAtTheCornerForAQuarterPoint) {
  for (const double at : {0.26, 0.5, 0.74}) {
    Nodes nodes = straight(kUnit);
    nodes[4] = {at, 0, 0};
    EXPECT_EQ(exact::jacobian_of(nodes), Jacobian::positive) << at;
  }
  for (const double at : {0.25, 0.75, 0.2, 0.9, -1.0}) {
    Nodes nodes = straight(kUnit);
    nodes[4] = {at, 0, 0};
    EXPECT_EQ(exact::jacobian_of(nodes), Jacobian::not_positive) << at;
  }
}

// The verdict agrees with values of the determinant at many points.
TEST(JacobianOfElement, AgreesWithSamples) {
  std::uint64_t state = 1;
  const auto random = [&] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 40) / double(1 << 24) - 0.5;
  };
  int positive = 0, other = 0;
  for (int round = 0; round < 300; ++round) {
    Nodes nodes = straight(kUnit);
    const double most = 0.1 + 0.4 * (round % 10) / 10;
    for (std::size_t e = 4; e < 10; ++e)
      for (double& x : nodes[e]) x += most * random();
    double least = 1e300;
    for (int i = 0; i <= 8; ++i)
      for (int j = 0; i + j <= 8; ++j)
        for (int k = 0; i + j + k <= 8; ++k)
          least = std::min(least, jacobian_at(nodes, {(8.0 - i - j - k) / 8, i / 8.0, j / 8.0, k / 8.0}));
    const Jacobian verdict = exact::jacobian_of(nodes);
    ASSERT_NE(verdict, Jacobian::unknown);
    if (verdict == Jacobian::positive) {
      EXPECT_GT(least, 0);
      ++positive;
    } else {
      // Zero may lie between samples, but not far below them.
      EXPECT_LT(least, 0.25);
      ++other;
    }
    if (least <= 0) {
      EXPECT_EQ(verdict, Jacobian::not_positive);
    }
  }
  EXPECT_GT(positive, 30);
  EXPECT_GT(other, 30);
}

/// A sphere of radius 1 by n rings.
Surface sphere(int n) {
  Surface s;
  s.vertices.push_back({0, 0, 1});
  const auto ring = [&](int i, int j) { return static_cast<Index>(1 + (i - 1) * n + j % n); };
  for (int i = 1; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double t = std::numbers::pi * i / n, f = 2 * std::numbers::pi * j / n;
      s.vertices.push_back({std::sin(t) * std::cos(f), std::sin(t) * std::sin(f), std::cos(t)});
    }
  s.vertices.push_back({0, 0, -1});
  const auto last = static_cast<Index>(s.vertices.size() - 1);
  for (int j = 0; j < n; ++j) {
    s.facets.push_back({0, ring(1, j), ring(1, j + 1)});
    s.facets.push_back({last, ring(n - 1, j + 1), ring(n - 1, j)});
    for (int i = 1; i < n - 1; ++i) {
      s.facets.push_back({ring(i, j), ring(i + 1, j), ring(i + 1, j + 1)});
      s.facets.push_back({ring(i, j), ring(i + 1, j + 1), ring(i, j + 1)});
    }
  }
  return s;
}

TEST(CurvedNodes, LieOnTheSmoothSurfaceAndElementsStayPositive) {
  const Surface coarse = sphere(12), fine = sphere(96);
  Result result = mesh(coarse, {});
  ASSERT_EQ(result.outcome, Outcome::done);
  Volume& volume = result.volume;
  const CurveReport report = curve_mid_nodes(volume, fine.view());
  EXPECT_EQ(report.on_facets, 3 * coarse.facets.size() / 2);
  EXPECT_EQ(report.moved + report.beyond + report.straightened, report.on_facets);
  EXPECT_GT(report.moved, report.on_facets * 3 / 4);
  EXPECT_EQ(report.not_positive, 0u);
  std::size_t on_sphere = 0;
  for (const auto& nodes : volume.mid_nodes.facets)
    for (const Index n : nodes) {
      const Point& p = volume.mid_nodes.points[n - volume.vertices.size()];
      on_sphere += std::abs(std::hypot(p[0], p[1], p[2]) - 1) < 1e-3 ? 1 : 0;
    }
  EXPECT_EQ(on_sphere, 2 * report.moved) << "each is on two facets";
  const CheckResult checked = check(coarse.view(), volume);
  EXPECT_TRUE(checked.holds());
  EXPECT_EQ(checked.rules.size(), 15u);
}

TEST(CurvedNodes, BeyondTheToleranceStayStraight) {
  const Surface coarse = sphere(8), fine = sphere(64);
  Result result = mesh(coarse, {});
  ASSERT_EQ(result.outcome, Outcome::done);
  add_mid_nodes(result.volume);
  const MidNodes before = result.volume.mid_nodes;
  CurveOptions options;
  options.tolerance = 1e-9;
  const CurveReport report = curve_mid_nodes(result.volume, fine.view(), options);
  EXPECT_EQ(report.beyond, report.on_facets);
  EXPECT_EQ(result.volume.mid_nodes.points, before.points);
}

// A smooth surface as deep as the height of the element would invert it.
TEST(CurvedNodes, GoBackIfAnElementWouldBeInverted) {
  Volume volume;
  volume.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, 0.01}};
  volume.tetrahedra = {{0, 1, 2, 3}};
  volume.facets = {{0, 2, 1}};
  const Surface above = small::surface_of({{-9, -9, 0.3}, {9, -9, 0.3}, {0, 9, 0.3}}, {{0, 1, 2}});
  CurveOptions options;
  options.tolerance = 1;
  const CurveReport report = curve_mid_nodes(volume, above.view(), options);
  EXPECT_EQ(report.straightened, 3u);
  EXPECT_EQ(report.moved, 0u);
  EXPECT_EQ(volume.mid_nodes.points[0], (Point{0.5, 0, 0}));
}

TEST(CurvedNodes, RefusesNonsense) {
  Volume volume;
  volume.vertices = {kUnit[0], kUnit[1], kUnit[2], kUnit[3]};
  volume.tetrahedra = {{0, 1, 2, 3}};
  const Surface out_of_range = small::surface_of({{0, 0, 0}}, {{0, 1, 2}});
  EXPECT_THROW(static_cast<void>(curve_mid_nodes(volume, out_of_range.view())), std::out_of_range);
  CurveOptions options;
  options.tolerance = std::nan("");
  EXPECT_THROW(static_cast<void>(curve_mid_nodes(volume, {}, options)), std::invalid_argument);
}

class CheckSecondOrder : public ::testing::Test {
 protected:
  void SetUp() override {
    Options options;
    options.sizes = Sizes{.size = 0.5};
    surface_ = small::box();
    Result result = mesh(surface_, options);
    ASSERT_EQ(result.outcome, Outcome::done);
    volume_ = result.volume;
    add_mid_nodes(volume_);
  }
  [[nodiscard]] bool holds(RuleKind kind) const {
    for (const Rule& rule : check(surface_.view(), volume_).rules)
      if (rule.kind == kind) return rule.holds;
    ADD_FAILURE() << "no such rule";
    return false;
  }

  Surface surface_;
  Volume volume_;
};

TEST_F(CheckSecondOrder, AcceptsStraightNodesAndAddsNoRuleWithoutAny) {
  EXPECT_TRUE(check(surface_.view(), volume_).holds());
  volume_.mid_nodes = {};
  EXPECT_EQ(check(surface_.view(), volume_).rules.size(), 13u);
}

TEST_F(CheckSecondOrder, FindsANodeOffTheMiddle) {
  const MidNodes& mid = volume_.mid_nodes;
  std::vector<bool> on_facet(mid.points.size());
  for (const auto& nodes : mid.facets)
    for (const Index n : nodes) on_facet[n - volume_.vertices.size()] = true;
  const auto inner =
      static_cast<std::size_t>(std::find(on_facet.begin(), on_facet.end(), false) - on_facet.begin());
  ASSERT_LT(inner, on_facet.size());
  volume_.mid_nodes.points[inner][0] += 1e-6;
  EXPECT_FALSE(holds(RuleKind::mid_nodes_placed));
  EXPECT_TRUE(holds(RuleKind::jacobians_positive));
}

TEST_F(CheckSecondOrder, FindsNodesSwappedDoubledMissingAndUnused) {
  const Volume good = volume_;
  std::swap(volume_.mid_nodes.tetrahedra[0][4], volume_.mid_nodes.tetrahedra[0][5]);
  EXPECT_FALSE(holds(RuleKind::mid_nodes_placed)) << "Gmsh's order";
  volume_ = good;
  volume_.mid_nodes.points.push_back(
      volume_.mid_nodes.points[volume_.mid_nodes.tetrahedra[0][0] - volume_.vertices.size()]);
  EXPECT_FALSE(holds(RuleKind::mid_nodes_placed)) << "on no edge";
  volume_.mid_nodes.tetrahedra[0][0] =
      static_cast<Index>(volume_.vertices.size() + volume_.mid_nodes.points.size() - 1);
  EXPECT_FALSE(holds(RuleKind::mid_nodes_placed)) << "two of an edge";
  volume_ = good;
  volume_.mid_nodes.tetrahedra[0][0] = 0;
  EXPECT_FALSE(holds(RuleKind::mid_nodes_placed)) << "a corner";
  EXPECT_FALSE(holds(RuleKind::jacobians_positive));
  volume_ = good;
  volume_.mid_nodes.tetrahedra.pop_back();
  EXPECT_FALSE(holds(RuleKind::mid_nodes_placed));
}

TEST_F(CheckSecondOrder, FindsAnInvertedElement) {
  const Index n = volume_.mid_nodes.facets[0][0] - static_cast<Index>(volume_.vertices.size());
  volume_.mid_nodes.points[n] = {0.5, 0.5, 0.5};
  EXPECT_FALSE(holds(RuleKind::jacobians_positive));
  volume_.mid_nodes.points[n][0] = std::nan("");
  EXPECT_FALSE(holds(RuleKind::jacobians_positive));
}

TEST(NearestPoint, OfATriangleIsOnItsCornerSideOrInside) {
  const Point a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  EXPECT_EQ(nearest_on_triangle({-1, -1, 2}, a, b, c), a);
  EXPECT_EQ(nearest_on_triangle({3, 0, 1}, a, b, c), b);
  EXPECT_EQ(nearest_on_triangle({0.5, -2, 0}, a, b, c), (Point{0.5, 0, 0}));
  EXPECT_EQ(nearest_on_triangle({1, 1, 1}, a, b, c), (Point{0.5, 0.5, 0}));
  EXPECT_EQ(nearest_on_triangle({0.25, 0.25, 7}, a, b, c), (Point{0.25, 0.25, 0}));
}

TEST(NearestPoint, OfASurfaceIsThatOfAllTriangles) {
  const Surface s = sphere(20);
  const NearestOnSurface nearest(s.vertices, s.facets);
  for (int i = 0; i < 200; ++i) {
    const Point p{std::sin(i * 1.7), std::cos(i * 2.3), std::sin(i * 0.9 + 1)};
    double best = 1e300;
    for (const Triangle& t : s.facets) {
      const Point q = nearest_on_triangle(p, s.vertices[t[0]], s.vertices[t[1]], s.vertices[t[2]]);
      best = std::min(best, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
    }
    double distance = 10;
    Point q{};
    ASSERT_TRUE(nearest.find(p, distance, q));
    EXPECT_NEAR(distance, best, 1e-12);
    distance = best / 2;
    EXPECT_FALSE(nearest.find(p, distance, q));
  }
}

}  // namespace
}  // namespace holdfast::second_order_test
