// What a mesh means for computation: eigenvalues and shares (holdfast/condition.h); and sizes from functions
// near large triangles.
#include "holdfast/condition.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "checked_mesh.h"
#include "hard_surfaces.h"
#include "holdfast/holdfast.h"
#include "numbers/vector.h"
#include "small_surfaces.h"

namespace holdfast::condition_test {
namespace {

using testing::mesh_with;

// The largest eigenvalue by power iteration, over all vertices.
double largest_eigenvalue(const Volume& volume) {
  std::vector<double> x(volume.vertices.size()), y;
  for (std::size_t v = 0; v < x.size(); ++v) x[v] = std::sin(1.0 + 7.0 * static_cast<double>(v * v % 1009));
  double eigenvalue = 0;
  for (int round = 0; round < 300; ++round) {
    y.assign(x.size(), 0);
    for (const Tetrahedron& t : volume.tetrahedra) {
      const auto& v = volume.vertices;
      std::array<Vector, 4> area{};
      for (std::size_t i = 0; i < 4; ++i) {
        const Point &p = v[t[(i + 1) % 4]], &q = v[t[(i + 2) % 4]], &r = v[t[(i + 3) % 4]];
        area[i] = cross(q - p, r - p);
        for (double& c : area[i]) c *= i % 2 == 0 ? 0.5 : -0.5;
      }
      const double measure = dot(v[t[1]] - v[t[0]], cross(v[t[2]] - v[t[0]], v[t[3]] - v[t[0]])) / 6;
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) y[t[i]] += dot(area[i], area[j]) / (9 * measure) * x[t[j]];
    }
    double norm = 0, product = 0;
    for (std::size_t v = 0; v < x.size(); ++v) {
      product += x[v] * y[v];
      norm += y[v] * y[v];
    }
    eigenvalue = product;
    for (std::size_t v = 0; v < x.size(); ++v) x[v] = y[v] / std::sqrt(norm);
  }
  return eigenvalue;
}

TEST(Condition, BoundsTheStiffnessMatrix) {
  for (const double size : {0.2, 0.5}) {
    const Surface sphere = hard::icosphere(2);
    const Result result = mesh_with(sphere, {.size = size});
    const double eigenvalue = largest_eigenvalue(result.volume);
    const Condition found = condition(result.volume);
    EXPECT_GE(found.stiffness_bound, eigenvalue);
    EXPECT_LE(found.stiffness_bound, 8 * eigenvalue);
    EXPECT_LE(found.element_eigenvalue, eigenvalue * (1 + 1e-3));
  }
}

// A regular tetrahedron of unit edges: K = V g g^T with gradients of length sqrt(3/2), whose only nonzero
// eigenvalue is sqrt(2)/12 * 2; with a single element the bound equals it.
TEST(Condition, OfARegularTetrahedron) {
  const Surface s = small::surface_of(
      {{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(3) / 2, 0}, {0.5, std::sqrt(3) / 6, std::sqrt(2.0 / 3)}},
      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  const Result result = mesh(s.view());
  ASSERT_EQ(result.volume.tetrahedra.size(), 1u);
  const Condition elements = condition(result.volume);
  EXPECT_NEAR(elements.element_eigenvalue, std::sqrt(2) / 6, 1e-12);
  EXPECT_NEAR(elements.stiffness_bound, std::sqrt(2) / 6, 1e-12);
  EXPECT_EQ(elements.below, (std::array<std::size_t, 3>{}));
}

TEST(Condition, SharesOfVolume) {
  const Surface box = small::box({0, 0, 0}, {1, 1, 0.1});
  const Result result = mesh(box.view());
  const Condition elements = condition(result.volume);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LE(elements.volume_below[k], 1 + 1e-12);
    EXPECT_EQ(elements.volume_below[k] > 0, elements.below[k] > 0);
  }
  EXPECT_GT(elements.below[0], 0u);
}

// A function of the user cannot bypass what triangles bear.
TEST(Limits, HoldForFunctionsToo) {
  const Surface box = small::box();
  const Result number = mesh_with(box, {.size = 0.1});
  const Result function = mesh_with(box, {.field = [](const Point&) { return 0.1; }});
  const auto share = [](const Result& r) {
    return static_cast<double>(condition(r.volume).below[1]) / static_cast<double>(r.report.tetrahedra);
  };
  EXPECT_LT(share(function), 1.5 * share(number) + 0.01);
  const double ratio =
      static_cast<double>(function.report.tetrahedra) / static_cast<double>(number.report.tetrahedra);
  EXPECT_GT(ratio, 0.7);
  EXPECT_LT(ratio, 1.4);
}

}  // namespace
}  // namespace holdfast::condition_test
