#include "metric/metric.h"

#include <algorithm>

#include "metric/eigen.h"
#include "numbers/elementary.h"

namespace holdfast {
namespace {

Matrix matrix_of(const Metric& m) { return {{{m[0], m[1], m[3]}, {m[1], m[2], m[4]}, {m[3], m[4], m[5]}}}; }

// sum of values[k] axes[k] axes[k]^T
Metric metric_of(const Matrix& axes, const std::array<double, 3>& values) {
  const auto entry = [&](std::size_t i, std::size_t j) {
    return values[0] * axes[0][i] * axes[0][j] + values[1] * axes[1][i] * axes[1][j] +
           values[2] * axes[2][i] * axes[2][j];
  };
  return {entry(0, 0), entry(0, 1), entry(1, 1), entry(0, 2), entry(1, 2), entry(2, 2)};
}

// Replaces each eigenvalue by f of it.
template <typename Function>
Metric with_eigenvalues(const Metric& m, Function&& f) {
  auto [values, axes] = eigen(matrix_of(m));
  for (double& value : values) value = f(value);
  return metric_of(axes, values);
}

// The lower triangle L of L L^T = m. Rounding may lose a pivot where sizes differ by eight orders of
// magnitude.
Matrix root_of(const Metric& m) {
  constexpr double kLeast = 1e-16;
  Matrix l{};
  l[0][0] = std::sqrt(m[0]);
  l[1][0] = m[1] / l[0][0];
  l[2][0] = m[3] / l[0][0];
  l[1][1] = std::sqrt(std::max(m[2] - l[1][0] * l[1][0], kLeast * m[2]));
  l[2][1] = (m[4] - l[2][0] * l[1][0]) / l[1][1];
  l[2][2] = std::sqrt(std::max(m[5] - l[2][0] * l[2][0] - l[2][1] * l[2][1], kLeast * m[5]));
  return l;
}

// The transpose of l^-1 m.
Matrix solved(const Matrix& l, const Matrix& m) {
  Matrix out{};
  for (std::size_t k = 0; k < 3; ++k) {
    out[k][0] = m[0][k] / l[0][0];
    out[k][1] = (m[1][k] - l[1][0] * out[k][0]) / l[1][1];
    out[k][2] = (m[2][k] - l[2][0] * out[k][0] - l[2][1] * out[k][1]) / l[2][2];
  }
  return out;
}

// Decides by the pivots of elimination.
bool is_positive(const Metric& m) {
  const double first = m[0], m22 = m[2] - m[1] * m[1] / first, m23 = m[4] - m[1] * m[3] / first;
  const double last = m[5] - m[3] * m[3] / first - m23 * m23 / m22;
  return first > 0 && m22 > 0 && last > 0;
}

// Whether no vector is shorter in a than in b; nearly equal lengths count as equal.
bool dominates(const Metric& a, const Metric& b) {
  constexpr double kSlack = 1 + 1e-9;
  return is_positive(kSlack * a + -1.0 * b);
}

}  // namespace

double length(const Metric& a, const Metric& b, const std::array<double, 3>& e) {
  constexpr double kEqual = 1e-3;
  const double l = length(a, e), m = length(b, e);
  return std::abs(l - m) < kEqual * l ? 0.5 * (l + m) : (l - m) / numbers::log(l / m);
}

double largest_size(const Metric& m) {
  const auto values = eigen(matrix_of(m)).values;
  // Rounding may lose a small eigenvalue: see Frame.
  constexpr double kLeast = 1e-16;
  const auto [least, most] = std::minmax({values[0], values[1], values[2]});
  return 1 / std::sqrt(std::max(least, kLeast * most));
}

bool is_positive_definite(const Metric& m) {
  return std::all_of(m.begin(), m.end(), [](double x) { return std::isfinite(x); }) && is_positive(m);
}

Metric intersection(const Metric& a, const Metric& b) {
  if (dominates(a, b)) return a;
  if (dominates(b, a)) return b;
  // In coordinates where `a` is the unit metric, both metrics are diagonal along the axes of b.
  const Matrix to_space = root_of(a);
  auto [values, axes] = eigen(solved(to_space, solved(to_space, matrix_of(b))));
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<double, 3> v = axes[k];
    for (std::size_t i = 0; i < 3; ++i)
      axes[k][i] = to_space[i][0] * v[0] + to_space[i][1] * v[1] + to_space[i][2] * v[2];
    values[k] = std::max(values[k], 1.0);
  }
  return metric_of(axes, values);
}

Metric logarithm(const Metric& m) { return with_eigenvalues(m, numbers::log); }

Metric exponential(const Metric& m) { return with_eigenvalues(m, numbers::exp); }

}  // namespace holdfast
