// The smoothing of tangled meshes: the energy's gradient, the minimiser.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "untangle/foldover_energy.h"
#include "untangle/lbfgs.h"

namespace holdfast::untangle_energy_test {
namespace {

TEST(FoldoverEnergy, ARegularTetrahedronIsBest) {
  FoldoverEnergy energy({{0, 1, 2, 3}}, 4, {});
  const std::vector<double> x{
      0, 0, 0, 1, 0, 0, 0.5, std::sqrt(0.75), 0, 0.5, std::sqrt(1 / 12.0), std::sqrt(2 / 3.0)};
  energy.take_sizes(x);
  energy.set_epsilon(1e-9);
  EXPECT_NEAR(energy.least_determinant(x), 1, 1e-12);
  std::vector<double> gradient(12);
  EXPECT_NEAR(energy(x, gradient), 1.05, 1e-9);  // 1 for the shape, lambda for the size
  for (const double g : gradient) EXPECT_NEAR(g, 0, 1e-9);
}

TEST(FoldoverEnergy, TheGradientIsThatOfTheValue) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> u(-1, 1);
  for (const double epsilon : {1.0, 0.1, 0.01}) {
    // Four variable vertices and two fixed ones; some tetrahedra are inverted.
    FoldoverEnergy energy({{0, 1, 2, 3}, {1, 2, 3, 4}, {5, 0, 4, 2}, {3, 1, 5, 0}}, 4,
                          {{u(random), u(random), u(random)}, {u(random), u(random), u(random)}});
    std::vector<double> x(12);
    for (double& c : x) c = u(random);
    energy.take_sizes(x);
    energy.set_epsilon(epsilon);
    std::vector<double> gradient(12);
    EXPECT_EQ(energy(x, gradient), energy.value(x));
    for (std::size_t i = 0; i < x.size(); ++i) {
      constexpr double kStep = 1e-6;
      std::vector<double> low = x, high = x;
      low[i] -= kStep;
      high[i] += kStep;
      const double slope = (energy.value(high) - energy.value(low)) / (2 * kStep);
      EXPECT_NEAR(gradient[i], slope, 1e-4 * (1 + std::abs(slope))) << epsilon << " " << i;
    }
  }
}

TEST(Lbfgs, FindsTheEndOfACurvedValley) {
  // Rosenbrock's function in ten variables.
  const auto function = [](std::span<const double> x, std::span<double> gradient) {
    std::fill(gradient.begin(), gradient.end(), 0.0);
    double sum = 0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const double a = x[i + 1] - x[i] * x[i], b = 1 - x[i];
      sum += 100 * a * a + b * b;
      gradient[i] += -400 * a * x[i] - 2 * b;
      gradient[i + 1] += 200 * a;
    }
    return sum;
  };
  std::vector<double> x(10, -1.2);
  EXPECT_LT(minimise(x, function, {1000, 0}), 1e-12);
  for (const double c : x) EXPECT_NEAR(c, 1, 1e-5);
}

TEST(Lbfgs, StaysIfTheFunctionIsNotANumberFartherOut) {
  const auto function = [](std::span<const double> x, std::span<double> gradient) {
    gradient[0] = 1 - 1 / x[0];
    return x[0] - std::log(x[0]);
  };
  std::vector<double> x{30};
  minimise(x, function, {200, 0});
  EXPECT_NEAR(x[0], 1, 1e-6);
}

}  // namespace
}  // namespace holdfast::untangle_energy_test
