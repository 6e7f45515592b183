// Short bases of the integer lattice, in one to three dimensions, under a quadratic form.
//
// In two dimensions Lagrange's reduction, in three Semaev's ("A 3-dimensional lattice reduction algorithm",
// 2001), which ends with a basis reduced in Minkowski's sense: in so few dimensions better than that of
// Lenstra, Lenstra and Lovasz (1982), and as simple.
#pragma once

#include <array>

#include "exact/dyadic.h"

namespace holdfast::exact {

using IntegerVector = std::array<BigInt, 3>;
using IntegerMatrix = std::array<IntegerVector, 3>;  ///< by rows

/// The rows of a unimodular matrix, shortest first, where c G c is the square of the length of c. G is
/// symmetric and positive definite; only its first `dimension` rows and columns count, and the result's.
[[nodiscard]] IntegerMatrix reduced_basis(int dimension, const IntegerMatrix& gram);

/// The inverse of a unimodular matrix.
[[nodiscard]] IntegerMatrix inverse_of_unimodular(int dimension, const IntegerMatrix& m);

}  // namespace holdfast::exact
