// Eigenvalues and eigenvectors of symmetric matrices of three rows. (In the Eigen library the order of
// operations, and so the last bits, depend on its version and on the processor's vectors.)
#pragma once

#include <array>

namespace holdfast {

using Matrix = std::array<std::array<double, 3>, 3>;

struct Eigen {
  std::array<double, 3> values;  ///< in no order
  Matrix vectors;                ///< rows of unit length, at right angles
};

/// Of a symmetric matrix, of which the upper triangle is read. Small eigenvalues of positive definite ones
/// are as accurate, relative to their size, as the matrix determines them (Demmel, Veselic 1992).
[[nodiscard]] Eigen eigen(Matrix m);

}  // namespace holdfast
