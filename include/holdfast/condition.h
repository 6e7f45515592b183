// Holdfast: what a mesh means for who computes with it: the shares of bad elements, and how large the
// eigenvalues of the stiffness matrix are.
#pragma once

#include <array>
#include <cstddef>

#include "holdfast/export.h"
#include "holdfast/types.h"

namespace holdfast {

struct Condition {
  /// Elements with a dihedral angle below 10, 20 and 30 degrees by more than 1e-6: their number, and their
  /// part of the volume, 0 to 1.
  std::array<std::size_t, 3> below{};
  std::array<double, 3> volume_below{};
  /// The largest eigenvalue of the stiffness matrix of an element, and a bound on that of the whole matrix:
  /// an explicit method's time step and an iterative solver's condition follow it. In units of length;
  /// infinite for a mesh with a null element.
  double element_eigenvalue = 0, stiffness_bound = 0;
};

/// Of linear elements for Poisson's equation with coefficient 1 (J.R. Shewchuk, "What is a good linear
/// element?", 2002). The matrix of an element with volume V and outward area vectors s is s_i . s_j / (9 V).
/// That of the whole has no eigenvalue above the most, over vertices, of the sum of the largest eigenvalues
/// of the elements there: x^T K x is the sum of x_t^T K_t x_t over elements t, each at most lambda_t |x_t|^2.
/// Throws std::out_of_range for indices of no vertex.
[[nodiscard]] HOLDFAST_API Condition condition(const Volume& volume);

}  // namespace holdfast
