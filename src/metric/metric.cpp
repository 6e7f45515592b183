#include "metric/metric.h"

#include <Eigen/Dense>
#include <algorithm>

namespace holdfast {
namespace {

using Matrix = Eigen::Matrix3d;

Matrix matrix_of(const Metric& m) {
  Matrix matrix;
  matrix << m[0], m[1], m[3],  //
      m[1], m[2], m[4],        //
      m[3], m[4], m[5];
  return matrix;
}

Metric metric_of(const Matrix& m) { return {m(0, 0), m(0, 1), m(1, 1), m(0, 2), m(1, 2), m(2, 2)}; }

// With f of each eigenvalue in its place.
template <typename Function>
Metric with_eigenvalues(const Metric& m, Function&& f) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(matrix_of(m));
  const Matrix& axes = solver.eigenvectors();
  const Eigen::Vector3d values = solver.eigenvalues().unaryExpr(f);
  return metric_of(axes * values.asDiagonal() * axes.transpose());
}

// By the pivots of elimination.
bool is_positive(const Metric& m) {
  const double first = m[0], m22 = m[2] - m[1] * m[1] / first, m23 = m[4] - m[1] * m[3] / first;
  const double last = m[5] - m[3] * m[3] / first - m23 * m23 / m22;
  return first > 0 && m22 > 0 && last > 0;
}

// Whether no vector is shorter in a than in b; nearly equal counts.
bool dominates(const Metric& a, const Metric& b) {
  constexpr double kSlack = 1 + 1e-9;
  return is_positive(kSlack * a + -1.0 * b);
}

}  // namespace

double length(const Metric& a, const Metric& b, const std::array<double, 3>& e) {
  constexpr double kEqual = 1e-3;
  const double l = length(a, e), m = length(b, e);
  return std::abs(l - m) < kEqual * l ? 0.5 * (l + m) : (l - m) / std::log(l / m);
}

double largest_size(const Metric& m) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(matrix_of(m), Eigen::EigenvaluesOnly);
  // Rounding may lose a small one: see Frame.
  constexpr double kLeast = 1e-16;
  return 1 / std::sqrt(std::max(solver.eigenvalues()[0], kLeast * solver.eigenvalues()[2]));
}

bool is_positive_definite(const Metric& m) {
  return std::all_of(m.begin(), m.end(), [](double x) { return std::isfinite(x); }) && is_positive(m);
}

Metric intersection(const Metric& a, const Metric& b) {
  if (dominates(a, b)) return a;
  if (dominates(b, a)) return b;
  // In coordinates where `a` is the unit metric, both are diagonal along the axes of b.
  const Matrix to_space = matrix_of(a).llt().matrixL();
  const auto lower = to_space.triangularView<Eigen::Lower>();
  const Matrix half = lower.solve(matrix_of(b));
  const Matrix whole = lower.solve(half.transpose());
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(whole);
  const Matrix axes = to_space * solver.eigenvectors();
  const Eigen::Vector3d values = solver.eigenvalues().cwiseMax(1);
  return metric_of(axes * values.asDiagonal() * axes.transpose());
}

Metric logarithm(const Metric& m) {
  return with_eigenvalues(m, [](double x) { return std::log(x); });
}

Metric exponential(const Metric& m) {
  return with_eigenvalues(m, [](double x) { return std::exp(x); });
}

}  // namespace holdfast
