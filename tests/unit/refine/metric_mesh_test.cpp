// Field points and the improvement of the volume with metrics, through the public API.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "checked_mesh.h"
#include "hard_surfaces.h"
#include "holdfast/check.h"
#include "holdfast/holdfast.h"
#include "holdfast/io.h"
#include "metric/metric.h"
#include "small_surfaces.h"

namespace holdfast::metric_mesh_test {
namespace {

using testing::mesh_with;

using Vector = std::array<double, 3>;

/// Size h across the direction n, of length 1, and t along the plane.
Metric layer(const Vector& n, double h, double t) {
  const double a = 1 / (h * h) - 1 / (t * t);
  return isotropic_metric(t) +
         a * Metric{n[0] * n[0], n[0] * n[1], n[1] * n[1], n[0] * n[2], n[1] * n[2], n[2] * n[2]};
}

constexpr double kAcross = 0.02, kAlong = 0.2;

/// A shock in the plane of a unit sphere that has this normal.
Metric shock(const Vector& n, const Point& p) {
  const double d = std::abs(n[0] * p[0] + n[1] * p[1] + n[2] * p[2]);
  return layer(n, std::min(kAlong, kAcross + 0.3 * d), kAlong);
}

/// Edges between field points.
std::vector<std::array<Point, 2>> inner_edges(const Volume& volume, std::size_t surface_vertices) {
  std::set<std::array<Index, 2>> edges;
  for (const Tetrahedron& t : volume.tetrahedra)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j)
        if (std::min(t[i], t[j]) >= surface_vertices)
          edges.insert({std::min(t[i], t[j]), std::max(t[i], t[j])});
  std::vector<std::array<Point, 2>> points;
  for (const auto& [a, b] : edges) points.push_back({volume.vertices[a], volume.vertices[b]});
  return points;
}

Vector minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

struct Direction {
  const char* name;
  Vector normal;
};

class Shock : public ::testing::TestWithParam<Direction> {};

TEST_P(Shock, EdgesHaveUnitLengthAndElementsLieAlongTheLayer) {
  const Vector& n = GetParam().normal;
  const Surface sphere = hard::icosphere(3);
  const auto metric = [&](const Point& p) { return shock(n, p); };
  const Result result = mesh_with(sphere, {.metric = metric});

  const auto edges = inner_edges(result.volume, sphere.vertices.size());
  ASSERT_GT(edges.size(), 3000u);
  double sum = 0, across = 0, along = 0;
  std::size_t near_unit = 0, in_layer = 0;
  for (const auto& [a, b] : edges) {
    const Vector e = minus(b, a);
    const double l = length(metric(a), metric(b), e);
    sum += l;
    if (l > std::sqrt(0.5) && l < std::sqrt(2)) ++near_unit;
    const double height = std::abs(n[0] * a[0] + n[1] * a[1] + n[2] * a[2]);
    if (height > kAcross) continue;
    ++in_layer;
    const double rise = std::abs(n[0] * e[0] + n[1] * e[1] + n[2] * e[2]);
    across += rise;
    along += std::sqrt(std::max(0.0, e[0] * e[0] + e[1] * e[1] + e[2] * e[2] - rise * rise));
  }
  const auto count = static_cast<double>(edges.size());
  EXPECT_NEAR(sum / count, 1.05, 0.1);
  EXPECT_GT(static_cast<double>(near_unit) / count, 0.8);
  EXPECT_GT(in_layer, 300u);
  EXPECT_GT(along, 5 * across);

  // In the metric, elements are well shaped.
  const Report::Field& field = result.report.field;
  EXPECT_GT(field.after.min_dihedral_deg, 8);
  EXPECT_EQ(
      std::accumulate(field.after.least_dihedral.begin(), field.after.least_dihedral.end(), std::size_t{0}),
      result.volume.tetrahedra.size());
  const auto& lengths = field.edge_lengths;  // in bins of 1/8
  const auto near_one = std::accumulate(lengths.begin() + 5, lengths.begin() + 12, std::size_t{0});
  EXPECT_GT(10 * near_one, 7 * std::accumulate(lengths.begin(), lengths.end(), std::size_t{0}));

  // Isotropic sizes need many more elements.
  const Result isotropic = mesh_with(sphere, {.field = [&](const Point& p) {
                                       const double d = std::abs(n[0] * p[0] + n[1] * p[1] + n[2] * p[2]);
                                       return std::min(kAlong, kAcross + 0.3 * d);
                                     }});
  EXPECT_GT(isotropic.volume.tetrahedra.size(), 8 * result.volume.tetrahedra.size());
}

INSTANTIATE_TEST_SUITE_P(MetricMesh, Shock,
                         ::testing::Values(Direction{"along_an_axis", {0, 0, 1}},
                                           Direction{"across_all", {2.0 / 3, 1.0 / 3, 2.0 / 3}}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(MetricMesh, AnIsotropicMetricIsASize) {
  const Surface sphere = hard::icosphere(3);
  const auto tetrahedra = [&](const Sizes& sizes) {
    return static_cast<double>(mesh_with(sphere, sizes).volume.tetrahedra.size());
  };
  const double by_size = tetrahedra({.size = 0.1});
  EXPECT_NEAR(tetrahedra({.metric = [](const Point&) { return isotropic_metric(0.1); }}) / by_size, 1, 0.15);
  // The smaller of both counts, and a tensor that is not positive definite is no limit.
  EXPECT_NEAR(
      tetrahedra({.size = 0.1, .metric = [](const Point&) { return isotropic_metric(10); }}) / by_size, 1,
      0.15);
  EXPECT_NEAR(tetrahedra({.size = 0.1, .metric = [](const Point&) { return Metric{}; }}) / by_size, 1, 0.15);
  const Sizes no_limit{.metric = [](const Point&) { return Metric{1, 2, 1, 0, 0, 1}; }};
  EXPECT_LT(tetrahedra(no_limit) / tetrahedra({}), 1.5);
}

TEST(MetricMesh, OtherSizesLimitThoseOfTheMetric) {
  const Surface sphere = hard::icosphere(2);
  const auto mean = [&](const Sizes& sizes, const Options& options = {}) {
    const auto edges = inner_edges(mesh_with(sphere, sizes, options).volume, sphere.vertices.size());
    double sum = 0;
    for (const auto& [a, b] : edges) sum += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    return sum / static_cast<double>(edges.size());
  };
  const auto metric = [](const Point&) { return layer({0, 0, 1}, 0.05, 0.5); };
  EXPECT_GT(mean({.metric = metric}), 0.25);
  EXPECT_LT(mean({.size = 0.1, .metric = metric}), 0.12);
  EXPECT_LT(mean({.field = [](const Point&) { return 0.1; }, .metric = metric}), 0.12);
  Options options;
  options.regions = {{{0, 0, 0}, 7, 0.1}};
  EXPECT_LT(mean({.metric = metric}, options), 0.12);
}

TEST(MetricMesh, SizesOfTheSurfaceSpreadInward) {
  const Surface sphere = hard::icosphere(4);  // edges of 0.07 to 0.08
  const auto count = [&](double gradation) {
    const auto metric = [](const Point&) { return layer({0, 0, 1}, 0.05, 0.5); };
    return mesh_with(sphere, {.gradation = gradation, .metric = metric}).volume.tetrahedra.size();
  };
  EXPECT_GT(2 * count(0.1), 3 * count(0.5));
}

// Improved in parts: the mesh is large enough.
TEST(MetricMesh, ThreadsMakeNoDifference) {
  const Surface sphere = hard::icosphere(4);
  const auto on = [&](unsigned threads) {
    Options options;
    options.threads = threads;
    options.effort = Effort::fast;
    const auto metric = [](const Point& p) {
      const double r = std::hypot(p[0], p[1], p[2]) + 1e-9;
      return layer({p[0] / r, p[1] / r, p[2] / r}, std::min(0.06, 0.008 + 0.3 * std::abs(r - 0.6)), 0.06);
    };
    return mesh_with(sphere, {.metric = metric}, options);
  };
  const Result one = on(1), three = on(3);
  EXPECT_GT(one.volume.tetrahedra.size(), 60'000u);
  EXPECT_EQ(one.volume.vertices, three.volume.vertices);
  EXPECT_EQ(one.volume.tetrahedra, three.volume.tetrahedra);
  EXPECT_EQ(one.report.field.after.least_dihedral, three.report.field.after.least_dihedral);
  EXPECT_EQ(one.report.field.edge_lengths, three.report.field.edge_lengths);
}

TEST(MetricMesh, TheUnitDoesNotMatter) {
  const Surface sphere = hard::icosphere(2);
  const auto with_unit = [&](int k) {
    Surface scaled = sphere;
    for (Point& p : scaled.vertices)
      for (double& x : p) x = std::ldexp(x, k);
    return mesh_with(scaled, {.metric = [k](const Point& p) {
                       const Point q{std::ldexp(p[0], -k), std::ldexp(p[1], -k), std::ldexp(p[2], -k)};
                       Metric m = shock({0, 0, 1}, q);
                       for (double& x : m) x = std::ldexp(x, -2 * k);
                       return m;
                     }});
  };
  const Result usual = with_unit(0);
  for (const int k : {-300, -40, 40, 300})
    EXPECT_EQ(with_unit(k).volume.tetrahedra, usual.volume.tetrahedra) << k;
}

// Points of the surface stay where they are, whatever the metric asks for.
TEST(MetricMesh, ThePromiseHoldsWithExtremeMetrics) {
  hard::Random random(5);
  for (const Surface& surface : {hard::icosphere(2), hard::star(random), small::nested(true)})
    for (const double across : {1e-3, 1e-6}) {
      Options options;
      options.keep = Keep::bounded;
      const auto metric = [&](const Point& p) {
        const double d = std::abs(0.6 * p[0] + 0.8 * p[2] - 0.1);
        return layer({0.6, 0, 0.8}, std::min(0.3, across + d), 0.3);
      };
      static_cast<void>(mesh_with(surface, {.metric = metric}, options));
    }
}

}  // namespace
}  // namespace holdfast::metric_mesh_test
