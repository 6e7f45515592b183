// Shares of bad elements, and bounds on eigenvalues.
#include "holdfast/condition.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "mesh/careful.h"
#include "mesh/quality.h"
#include "numbers/elementary.h"
#include "numbers/float_environment.h"
#include "numbers/vector.h"

namespace holdfast {
namespace {

// Cosines of 10, 20 and 30 degrees less 1e-6.
constexpr std::array<double, 3> kCosines{0.9848077560429404, 0.9396926267552859, 0.8660254124910848};

struct ElementStiffness {
  std::array<Vector, 4> normals{};  // twice the area vectors
  double six_volumes = 0;

  // Plain arithmetic is accurate enough unless the element is thin or tiny.
  ElementStiffness(const std::array<Point, 4>& p, bool is_plain) {
    if (!is_plain) {
      *this = ElementStiffness(p);
      return;
    }
    normals = {cross(p[3] - p[1], p[2] - p[1]), cross(p[2] - p[0], p[3] - p[0]),
               cross(p[3] - p[0], p[1] - p[0]), cross(p[1] - p[0], p[2] - p[0])};
    six_volumes = std::abs(dot(p[3] - p[0], normals[3]));
  }
  explicit ElementStiffness(const std::array<Point, 4>& p)
      : normals{careful::normal(p[1], p[3], p[2]), careful::normal(p[0], p[2], p[3]),
                careful::normal(p[0], p[3], p[1]), careful::normal(p[0], p[1], p[2])},
        six_volumes(std::abs(careful::six_volumes(p[0], p[1], p[2], p[3], normals[3]))) {}

  // The sum of the eigenvalues; at most three are not 0, so the largest is at least a third of it.
  [[nodiscard]] double trace() const {
    double sum = 0;
    for (const Vector& n : normals) sum += dot(n, n);
    return sum > 0 ? sum / (6 * six_volumes) : 0;
  }

  // The nonzero eigenvalues are those of the 3 x 3 matrix sum of n n^T / (6 * six volumes): the roots of a
  // cubic, by cosines (Smith 1961).
  [[nodiscard]] double largest_eigenvalue() const {
    const double all = trace();
    if (!(all > 0 && all < std::numeric_limits<double>::infinity())) return all;
    std::array<std::array<double, 3>, 3> m{};
    for (const Vector& n : normals)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) m[i][j] += n[i] * n[j] / (6 * six_volumes) / all;
    const double mean = 1.0 / 3;
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      m[i][i] -= mean;
      for (std::size_t j = 0; j < 3; ++j) square += m[i][j] * m[i][j];
    }
    const double radius = std::sqrt(square / 6);
    if (!(radius > 0)) return mean * all;
    const double det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                       m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                       m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    const double angle = numbers::acos(std::clamp(det / (2 * radius * radius * radius), -1.0, 1.0)) / 3;
    return (mean + 2 * radius * numbers::cos(angle)) * all;
  }
};

class Measuring {
 public:
  explicit Measuring(const Volume& volume) : volume_(volume) {}

  Condition run() {
    for (const Tetrahedron& t : volume_.tetrahedra) measure(t);
    for (double& part : found_.volume_below) part = all_ > 0 ? part / all_ : 0;
    bound_eigenvalue();
    return found_;
  }

 private:
  [[nodiscard]] std::array<Point, 4> corners(const Tetrahedron& t) const {
    const std::vector<Point>& v = volume_.vertices;
    return {v.at(t[0]), v.at(t[1]), v.at(t[2]), v.at(t[3])};
  }

  void measure(const Tetrahedron& t) {
    const std::array<Point, 4> p = corners(t);
    const auto plain = plain_shape(p[0], p[1], p[2], p[3]);
    const PlainShape shape = plain ? *plain : careful_shape(p[0], p[1], p[2], p[3]).plain();
    const double cosine = *std::max_element(shape.cosines.begin(), shape.cosines.end());
    const ElementStiffness element(p, plain.has_value());
    all_ += element.six_volumes;
    for (std::size_t i = 0; i < kCosines.size(); ++i)
      if (cosine > kCosines[i]) {
        ++found_.below[i];
        found_.volume_below[i] += element.six_volumes;
      }
    traces_.push_back(element.trace());
    if (traces_.back() > found_.element_eigenvalue)
      found_.element_eigenvalue = std::max(found_.element_eigenvalue, element.largest_eigenvalue());
  }

  // The sums of traces show at which vertices the bound may be largest; eigenvalues are computed only there.
  void bound_eigenvalue() {
    std::vector<double> sums(volume_.vertices.size(), 0);
    for (std::size_t t = 0; t < traces_.size(); ++t)
      for (const Index v : volume_.tetrahedra[t]) sums[v] += traces_[t];
    const double most = sums.empty() ? 0 : *std::max_element(sums.begin(), sums.end());
    const auto may_be_largest = [&](Index v) { return 3 * sums[v] >= most; };
    std::vector<double> eigenvalues(volume_.vertices.size(), 0);
    for (std::size_t t = 0; t < traces_.size(); ++t) {
      const Tetrahedron& c = volume_.tetrahedra[t];
      if (std::none_of(c.begin(), c.end(), may_be_largest)) continue;
      const double eigenvalue = ElementStiffness(corners(c)).largest_eigenvalue();
      for (const Index v : c)
        if (may_be_largest(v)) eigenvalues[v] += eigenvalue;
    }
    for (const double sum : eigenvalues) found_.stiffness_bound = std::max(found_.stiffness_bound, sum);
  }

  const Volume& volume_;
  std::vector<double> traces_;  // by tetrahedron
  double all_ = 0;              // six volumes
  Condition found_;
};

}  // namespace

Condition condition(const Volume& volume) {
  const FloatEnvironment environment;
  return Measuring(volume).run();
}

}  // namespace holdfast
