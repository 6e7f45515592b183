#include "untangle/foldover_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numbers/elementary.h"
#include "numbers/vector.h"
#include "untangle/tuning.h"

namespace holdfast {
namespace {

// Inverse of the matrix of the edges (1, 0, 0), (1/2, sqrt(3)/2, 0), (1/2, sqrt(3)/6, sqrt(6)/3) of a regular
// tetrahedron, which is upper triangular.
const double kInverse01 = -1 / std::sqrt(3.0), kInverse11 = 2 / std::sqrt(3.0);
const double kInverse02 = -1 / std::sqrt(6.0), kInverse22 = 3 / std::sqrt(6.0);

using Column = Vector;

}  // namespace

void FoldoverEnergy::take_sizes(std::span<const double> x) {
  inverse_size_.resize(tets_.size());
  for (std::size_t t = 0; t < tets_.size(); ++t) {
    double sum = 0;
    for (const auto& [i, k] : kEdgeVertex) {
      const double* a = corner(x, tets_[t][static_cast<std::size_t>(i)]);
      const double* b = corner(x, tets_[t][static_cast<std::size_t>(k)]);
      for (std::size_t c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
    }
    inverse_size_[t] = 1 / std::sqrt(std::max(sum / 6, 1e-30));
  }
}

FoldoverEnergy::Matrix FoldoverEnergy::jacobian(std::span<const double> x, std::size_t t) const {
  const double* o = corner(x, tets_[t][0]);
  Matrix e{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double* p = corner(x, tets_[t][k + 1]);
    for (std::size_t c = 0; c < 3; ++c) e[k][c] = (p[c] - o[c]) * inverse_size_[t];
  }
  Matrix j{};
  for (std::size_t c = 0; c < 3; ++c) {
    j[0][c] = e[0][c];
    j[1][c] = kInverse01 * e[0][c] + kInverse11 * e[1][c];
    j[2][c] = kInverse02 * (e[0][c] + e[1][c]) + kInverse22 * e[2][c];
  }
  return j;
}

double FoldoverEnergy::least_determinant(std::span<const double> x) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < tets_.size(); ++t) {
    const Matrix j = jacobian(x, t);
    least = std::min(least, dot(j[0], cross(j[1], j[2])));
  }
  return least;
}

double FoldoverEnergy::value(std::span<const double> x) const {
  std::vector<double> gradient(3 * variable_);
  return (*this)(x, gradient);
}

double FoldoverEnergy::operator()(std::span<const double> x, std::span<double> gradient) const {
  std::fill(gradient.begin(), gradient.end(), 0.0);
  double energy = 0;
  for (std::size_t t = 0; t < tets_.size(); ++t) {
    const Matrix j = jacobian(x, t);
    const Matrix cofactor{cross(j[1], j[2]), cross(j[2], j[0]), cross(j[0], j[1])};
    const double d = dot(j[0], cofactor[0]);
    const double root = std::sqrt(epsilon_ * epsilon_ + d * d);
    const double chi = d > 0 ? (d + root) / 2 : epsilon_ * epsilon_ / (2 * (root - d));
    const double slope = chi / root;  // derivative of chi
    const double trace = (dot(j[0], j[0]) + dot(j[1], j[1]) + dot(j[2], j[2])) / 3;
    const double root3 = numbers::cbrt(chi), power = root3 * root3;
    const double f = trace / power, g = (d * d + 1) / (2 * chi);
    energy += f + tuning::kLambda * g;

    const double by_j = 2.0 / 3.0 / power;
    const double by_d = -2.0 / 3.0 * f / chi * slope + tuning::kLambda * (d - g * slope) / chi;
    Matrix dj{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 3; ++c) dj[k][c] = by_j * j[k][c] + by_d * cofactor[k][c];
    add_to_corners(t, dj, gradient);
  }
  return energy;
}

// Passes on the derivative by J to the edges, and from these to the corners.
void FoldoverEnergy::add_to_corners(std::size_t t, const Matrix& dj, std::span<double> gradient) const {
  Matrix at{};  // for corners 1, 2, 3; corner 0 gets the negative of their sum
  for (std::size_t c = 0; c < 3; ++c) {
    at[0][c] = (dj[0][c] + kInverse01 * dj[1][c] + kInverse02 * dj[2][c]) * inverse_size_[t];
    at[1][c] = (kInverse11 * dj[1][c] + kInverse02 * dj[2][c]) * inverse_size_[t];
    at[2][c] = kInverse22 * dj[2][c] * inverse_size_[t];
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t v = tets_[t][i];
    if (v >= variable_) continue;
    for (std::size_t c = 0; c < 3; ++c)
      gradient[3 * v + c] += i == 0 ? -(at[0][c] + at[1][c] + at[2][c]) : at[i - 1][c];
  }
}

}  // namespace holdfast
