#include "exact/lattice_reduction.h"

#include <utility>

#include "exact/polytope.h"

namespace holdfast::exact {
namespace {

// A basis and the products of its vectors, updated together.
class Basis {
 public:
  Basis(std::size_t dimension, IntegerMatrix gram) : dimension_(dimension), gram_(std::move(gram)) {
    for (std::size_t k = 0; k < dimension; ++k) rows_[k][k] = 1;
  }
  [[nodiscard]] const BigInt& product(std::size_t i, std::size_t j) const { return gram_[i][j]; }
  [[nodiscard]] const BigInt& square(std::size_t i) const { return gram_[i][i]; }
  [[nodiscard]] const IntegerMatrix& rows() const { return rows_; }

  void add(std::size_t i, std::size_t j, const BigInt& times) {
    if (times.sign() == 0) return;
    for (std::size_t k = 0; k < dimension_; ++k) rows_[i][k] += times * rows_[j][k];
    for (std::size_t k = 0; k < dimension_; ++k) gram_[i][k] += times * gram_[j][k];
    for (std::size_t k = 0; k < dimension_; ++k) gram_[k][i] += times * gram_[k][j];
  }
  void swap(std::size_t i, std::size_t j) {
    std::swap(rows_[i], rows_[j]);
    std::swap(gram_[i], gram_[j]);
    for (std::size_t k = 0; k < dimension_; ++k) std::swap(gram_[k][i], gram_[k][j]);
  }

 private:
  std::size_t dimension_;
  IntegerMatrix gram_;
  IntegerMatrix rows_{};
};

BigInt nearest_integer_quotient(const BigInt& a, const BigInt& b) { return floor_of(2 * a + b, 2 * b); }

// Reduces vectors 0 and 1.
void reduce_two(Basis& basis) {
  for (;;) {
    if (basis.square(1) < basis.square(0)) basis.swap(0, 1);
    const BigInt times = nearest_integer_quotient(basis.product(0, 1), basis.square(0));
    basis.add(1, 0, -times);
    if (basis.square(0) <= basis.square(1)) return;
  }
}

// Reduces vector 2 by the nearest combination of the other two, which are reduced: it is one of the four
// round the projection of vector 2 to their plane.
void reduce_third(Basis& basis) {
  const BigInt &g00 = basis.square(0), &g11 = basis.square(1), &g01 = basis.product(0, 1);
  const BigInt &g02 = basis.product(0, 2), &g12 = basis.product(1, 2);
  const BigInt determinant = g00 * g11 - g01 * g01;
  const BigInt low0 = floor_of(g01 * g12 - g11 * g02, determinant);
  const BigInt low1 = floor_of(g01 * g02 - g00 * g12, determinant);
  BigInt best0 = 0, best1 = 0, least = 0;  // least: the least change of the square
  for (const int up0 : {0, 1})
    for (const int up1 : {0, 1}) {
      const BigInt y0 = low0 + up0, y1 = low1 + up1;
      const BigInt change = y0 * (y0 * g00 + 2 * (y1 * g01 + g02)) + y1 * (y1 * g11 + 2 * g12);
      if (change >= least) continue;
      best0 = y0;
      best1 = y1;
      least = change;
    }
  basis.add(2, 0, best0);
  basis.add(2, 1, best1);
}

BigInt cofactor(const IntegerMatrix& m, std::size_t i, std::size_t j) {
  const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
  return m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
}

}  // namespace

// Each pass shortens the longest vector, whose square is an integer; so the loop ends.
IntegerMatrix reduced_basis(int dimension, const IntegerMatrix& gram) {
  Basis basis(static_cast<std::size_t>(dimension), gram);
  if (dimension >= 2) reduce_two(basis);
  while (dimension == 3) {
    reduce_third(basis);
    if (basis.square(1) <= basis.square(2)) break;
    basis.swap(1, 2);
    reduce_two(basis);
  }
  return basis.rows();
}

IntegerMatrix inverse_of_unimodular(int dimension, const IntegerMatrix& matrix) {
  IntegerMatrix m = matrix;
  for (auto k = static_cast<std::size_t>(dimension); k < 3; ++k) {
    m[k] = {};
    m[k][k] = 1;
  }
  BigInt determinant = 0;
  for (std::size_t j = 0; j < 3; ++j) determinant += m[0][j] * cofactor(m, 0, j);
  IntegerMatrix out;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[j][i] = determinant * cofactor(m, i, j);
  return out;
}

}  // namespace holdfast::exact
