// Eigenvalues and eigenvectors of symmetric 3 x 3 matrices. (In the Eigen library the order of operations,
// and so the last bits, depend on the version and on the processor's vector units.)
#pragma once

#include <array>

namespace holdfast {

using Matrix = std::array<std::array<double, 3>, 3>;

struct Eigen {
  std::array<double, 3> values;  ///< in no order
  Matrix vectors;                ///< orthonormal rows
};

/// The eigenvalues of a symmetric matrix, of which only the upper triangle is read. Small eigenvalues of
/// positive definite matrices are as accurate, relative to their size, as the matrix determines them (Demmel,
/// Veselic 1992).
[[nodiscard]] Eigen eigen(Matrix m);

}  // namespace holdfast
