#include "metric/eigen.h"

#include <cmath>

namespace holdfast {
namespace {

struct Rotation {
  double sine, cosine, tangent;
};

// Of the two rotations that make entry pq zero, the one with the smaller angle.
Rotation rotation_of(double pp, double qq, double pq) {
  const double theta = (qq - pp) / (2 * pq);
  const double root = std::abs(theta) + std::sqrt(theta * theta + 1);
  const double tangent = (theta < 0 ? -1 : 1) / root, cosine = 1 / std::sqrt(tangent * tangent + 1);
  return {tangent * cosine, cosine, tangent};
}

}  // namespace

// Jacobi's rotations, by rows, until the off-diagonal entries are negligible. Three or four sweeps suffice.
Eigen eigen(Matrix m) {
  constexpr int kMostSweeps = 30;
  constexpr double kNothing = 0x1p-54;
  Matrix vectors{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  bool is_diagonal = false;
  for (int sweep = 0; sweep < kMostSweeps && !is_diagonal; ++sweep) {
    is_diagonal = true;
    for (std::size_t p = 0; p < 2; ++p)
      for (std::size_t q = p + 1; q < 3; ++q) {
        const double pq = m[p][q];
        if (!(std::abs(pq) > kNothing * std::sqrt(std::abs(m[p][p])) * std::sqrt(std::abs(m[q][q]))))
          continue;
        is_diagonal = false;
        const Rotation turn = rotation_of(m[p][p], m[q][q], pq);
        m[p][p] -= turn.tangent * pq;
        m[q][q] += turn.tangent * pq;
        m[p][q] = 0;
        const std::size_t r = 3 - p - q;  // the third index
        double& rp = r < p ? m[r][p] : m[p][r];
        double& rq = r < q ? m[r][q] : m[q][r];
        const double old = rp;
        rp = turn.cosine * old - turn.sine * rq;
        rq = turn.sine * old + turn.cosine * rq;
        for (std::size_t k = 0; k < 3; ++k) {
          const double of_p = vectors[p][k];
          vectors[p][k] = turn.cosine * of_p - turn.sine * vectors[q][k];
          vectors[q][k] = turn.sine * of_p + turn.cosine * vectors[q][k];
        }
      }
  }
  return {{m[0][0], m[1][1], m[2][2]}, vectors};
}

}  // namespace holdfast
