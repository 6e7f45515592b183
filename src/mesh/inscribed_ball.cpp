#include "mesh/inscribed_ball.h"

#include <cstddef>
#include <utility>

namespace holdfast {
namespace {

constexpr std::size_t kColumns = 7;  // y = (c0 - c1, c2 - c3, c4 - c5), radius = c6

// A dense tableau that starts feasible because every b is at least zero; so phase one is not needed.
class Tableau {
 public:
  explicit Tableau(std::span<const HalfSpace> half_spaces)
      : rows_(half_spaces.size()), basis_(half_spaces.size()), cost_{0, 0, 0, 0, 0, 0, 1} {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const HalfSpace& h = half_spaces[i];
      rows_[i] = {{h.n[0], -h.n[0], h.n[1], -h.n[1], h.n[2], -h.n[2], 1.0}, h.b};
      basis_[i] = kColumns + i;
    }
    for (std::size_t j = 0; j < kColumns; ++j) nonbasic_[j] = j;
  }

  // False if the programme is unbounded.
  bool solve() {
    constexpr int kSteepest = 60;     // then Bland's rule, which cannot cycle
    constexpr int kMostPivots = 600;  // a guess is enough
    for (int step = 0; step < kMostPivots; ++step) {
      const std::size_t column = entering(step < kSteepest);
      if (column == kColumns) return true;
      const std::size_t row = leaving(column);
      if (row == rows_.size()) return false;
      pivot(row, column);
    }
    return true;
  }

  [[nodiscard]] InscribedBall ball() const {
    std::array<double, kColumns> x{};
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (basis_[i] < kColumns) x[basis_[i]] = rows_[i].b;
    return {{x[0] - x[1], x[2] - x[3], x[4] - x[5]}, x[6]};
  }

 private:
  struct Row {
    std::array<double, kColumns> a;
    double b;
  };
  static constexpr double kZero = 1e-12;  // below it, an entry of the tableau is rounding

  [[nodiscard]] std::size_t entering(bool steepest) const {
    std::size_t best = kColumns;
    for (std::size_t j = 0; j < kColumns; ++j) {
      if (cost_[j] <= kZero) continue;
      if (best == kColumns || (steepest ? cost_[j] > cost_[best] : nonbasic_[j] < nonbasic_[best])) best = j;
    }
    return best;
  }

  [[nodiscard]] std::size_t leaving(std::size_t column) const {
    std::size_t best = rows_.size();
    double least = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i].a[column] <= kZero) continue;
      const double ratio = rows_[i].b / rows_[i].a[column];
      if (best == rows_.size() || ratio < least || (ratio == least && basis_[i] < basis_[best])) {
        best = i;
        least = ratio;
      }
    }
    return best;
  }

  void pivot(std::size_t row, std::size_t column) {
    Row& p = rows_[row];
    const double inverse = 1.0 / p.a[column];
    for (double& x : p.a) x *= inverse;
    p.b *= inverse;
    p.a[column] = inverse;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      if (k == row || rows_[k].a[column] == 0) continue;
      const double f = rows_[k].a[column];
      for (std::size_t j = 0; j < kColumns; ++j) rows_[k].a[j] -= f * p.a[j];
      rows_[k].a[column] = -f * inverse;
      rows_[k].b -= f * p.b;
      if (rows_[k].b < 0) rows_[k].b = 0;  // rounding only
    }
    const double f = cost_[column];
    for (std::size_t j = 0; j < kColumns; ++j) cost_[j] -= f * p.a[j];
    cost_[column] = -f * inverse;
    std::swap(basis_[row], nonbasic_[column]);
  }

  std::vector<Row> rows_;
  std::vector<std::size_t> basis_;
  std::array<std::size_t, kColumns> nonbasic_{};
  std::array<double, kColumns> cost_;
};

}  // namespace

InscribedBall inscribed_ball(std::span<const HalfSpace> half_spaces) {
  Tableau tableau(half_spaces);
  if (!tableau.solve()) return {};
  return tableau.ball();
}

}  // namespace holdfast
