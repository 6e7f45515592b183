#include "optimise/star.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "numbers/elementary.h"
#include "optimise/tuning.h"

namespace holdfast {

void Star::clear() {
  faces_.clear();
  face_count_ = 0;
  energy_ = kNoEnergy;
}

void Star::add(const Point& a, const Point& b, const Point& c, double weight) {
  const std::size_t i = face_count_ % 2;
  if (i == 0) {
    TwoFaces& two = faces_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      two.a[k] = Pair{} + a[k];
      two.b[k] = Pair{} + b[k];
      two.c[k] = Pair{} + c[k];
    }
    two.weight = Pair{} + weight;
  }
  TwoFaces& two = faces_.back();
  for (std::size_t k = 0; k < 3; ++k) {
    two.a[k][i] = a[k];
    two.b[k][i] = b[k];
    two.c[k][i] = c[k];
  }
  two.weight[i] = weight;
  two.index[i] = face_count_++;
  two.count = i + 1;
}

// The energy at x; infinite, or at least `limit`, if it is not below `limit`. Both ways add the same numbers
// in the same order.
double Star::energy_at(const Point& x, double limit) {
  static const bool by_fours = has_fours();
  return by_fours ? energy_by_fours(x, limit) : energy_by_pairs(x, limit);
}

// Adds the energies on the k-th faces. A face that decides is tried sooner next time.
bool Star::reaches(double limit, std::size_t k, const double* energies, double& sum) {
  sum += faces_[k].count == 2 ? energies[0] + energies[1] : energies[0];
  if (!(sum >= limit)) return false;
  if (k > 0) std::swap(faces_[k], faces_[k / 2]);
  return true;
}

double Star::energy_by_pairs(const Point& x, double limit) {
  double sum = 0;
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const Pair e = energies_at(faces_[k], x);
    const std::array<double, 2> energies{e[0], e[1]};
    if (reaches(limit, k, energies.data(), sum)) return sum;
  }
  return sum;
}

HOLDFAST_WITH_FOURS double Star::energy_by_fours(const Point& x, double limit) {
  double sum = 0;
  const std::size_t count = faces_.size();
  for (std::size_t k = 0; k < count; k += 2) {
    const TwoFaces &one = faces_[k], &other = faces_[std::min(k + 1, count - 1)];
    PointOf<Four> a, b, c, d;
    for (std::size_t i = 0; i < 3; ++i) {
      a[i] = Four{one.a[i][0], one.a[i][1], other.a[i][0], other.a[i][1]};
      b[i] = Four{one.b[i][0], one.b[i][1], other.b[i][0], other.b[i][1]};
      c[i] = Four{one.c[i][0], one.c[i][1], other.c[i][0], other.c[i][1]};
      d[i] = Four{} + x[i];
    }
    Four e{};
    put_energy<Four>(a, b, c, d, rule_, e);
    const std::array<double, 4> energies{e[0], e[1], e[2], e[3]};
    if (reaches(limit, k, energies.data(), sum)) return sum;
    if (k + 1 < count && reaches(limit, k + 1, energies.data() + 2, sum)) return sum;
  }
  return sum;
}

bool Star::step_to(const Point& x) {
  const double e = energy_at(x, energy_);
  if (!(e < energy_)) return false;
  energy_ = e;
  at_ = x;
  return true;
}

bool Star::step_to_ideal_place() {
  const Point from = at_, target = ideal_place();
  double part = 1;
  for (int trial = 0; trial < tuning::kIdealTrials; ++trial, part /= 2) {
    Point x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = from[k] + part * (target[k] - from[k]);
    if (step_to(x)) return true;
  }
  return false;
}

// The mean of the places over the centres of the faces, at the height of a regular tetrahedron.
Point Star::ideal_place() const {
  constexpr double kHeight = 0.8164965809277260;  // of a regular tetrahedron of unit edges
  // A triangle of this area has edges of length sqrt(4 / sqrt(3) * area).
  constexpr double kEdge2OfTwiceArea = 1.1547005383792515;
  Point sum{};
  double weights = 0;
  for (const auto& [a, b, c, weight, index, count] : faces_) {
    const Pair ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const Pair vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const PointOf<Pair> n{uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
    const Pair n2 = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    for (std::size_t i = 0; i < count; ++i) {
      if (!(n2[i] > 0)) continue;
      const double twice_area = std::sqrt(n2[i]);
      const double height = kHeight * std::sqrt(kEdge2OfTwiceArea * twice_area) / twice_area;
      weights += weight[i];
      for (std::size_t k = 0; k < 3; ++k)
        sum[k] += weight[i] * ((a[k][i] + b[k][i] + c[k][i]) / 3 + height * n[k][i]);
    }
  }
  if (!(weights > 0)) return at_;
  return {sum[0] / weights, sum[1] / weights, sum[2] / weights};
}

void Star::descend() {
  const double length = size();
  for (int k = 0; k < tuning::kDescentSteps && step_down(length); ++k) {
  }
}

// A mean side length of the faces.
double Star::size() const {
  Pair sum{};
  for (const TwoFaces& two : faces_)
    for (std::size_t k = 0; k < 3; ++k) sum += (two.b[k] - two.a[k]) * (two.b[k] - two.a[k]);
  return std::sqrt((sum[0] + sum[1]) / static_cast<double>(2 * faces_.size()));
}

// One step down the gradient, which is computed by differences. The first trial step is a part of the star's
// size.
bool Star::step_down(double size) {
  const double h = tuning::kDifference * size;
  Point gradient;
  for (std::size_t k = 0; k < 3; ++k) {
    Point x = at_;
    x[k] += h;
    gradient[k] = energy_at(x, kNoEnergy) - energy_;
  }
  const double length = numbers::hypot(gradient[0], gradient[1], gradient[2]);
  if (!(length > 0 && length < kNoEnergy)) return false;
  double step = tuning::kDescentStep * size;
  for (int trial = 0; trial < tuning::kDescentTrials; ++trial, step /= tuning::kStepDivisor) {
    Point x = at_;
    for (std::size_t k = 0; k < 3; ++k) x[k] -= step * gradient[k] / length;
    const double before = energy_;
    if (step_to(x)) return energy_ < tuning::kLeastDescent * before;
  }
  return false;
}

}  // namespace holdfast
