// Holdfast: how well a mesh suits computation: the share of bad elements, and bounds on the eigenvalues of
// the stiffness matrix.
#pragma once

#include <array>
#include <cstddef>

#include "holdfast/export.h"
#include "holdfast/types.h"

namespace holdfast {

struct Condition {
  /// Elements with a dihedral angle below 10, 20 and 30 degrees by more than 1e-6: their number, and their
  /// share of the volume, 0 to 1.
  std::array<std::size_t, 3> below{};
  std::array<double, 3> volume_below{};
  /// The largest eigenvalue of the stiffness matrix of an element, and a bound on the largest eigenvalue of
  /// the whole matrix. The time step of explicit methods and the condition number seen by iterative solvers
  /// depend on them. In units of length; infinite for a mesh with a null element.
  double element_eigenvalue = 0, stiffness_bound = 0;
};

/// The condition of linear elements for Poisson's equation with coefficient 1 (J.R. Shewchuk, "What is a good
/// linear element?", 2002). The matrix of an element with volume V and outward area vectors s is s_i . s_j /
/// (9 V). At each vertex, add the largest eigenvalues of its elements. No eigenvalue of the whole matrix
/// exceeds the maximum of these sums: x^T K x is the sum of x_t^T K_t x_t over elements t, each at most
/// lambda_t |x_t|^2. Throws std::out_of_range for indices of no vertex.
[[nodiscard]] HOLDFAST_API Condition condition(const Volume& volume);

}  // namespace holdfast
