// Where the Jacobian of a tetrahedron of second order is positive.
//
// The determinant of a quadratic map's Jacobian is a cubic polynomial in the barycentric coordinates. It lies
// between the least and the largest of its 20 Bernstein coefficients, and those at the corners are values of
// it; halving the element along an edge (de Casteljau) brings coefficients nearer to values (Johnen, Remacle,
// Geuzaine, Geometrical validity of curvilinear finite elements, J. Comput. Phys. 233, 2013).
#pragma once

#include <array>

namespace holdfast::exact {

enum class Jacobian {
  positive,      ///< everywhere in the element, proven
  not_positive,  ///< zero or negative at some point of it, proven
  unknown,       ///< so near to zero that halving came to no end
};

/// Of the four corners, then the nodes on the edges 01 12 02 03 13 23. All numbers are finite.
[[nodiscard]] Jacobian jacobian_of(const std::array<std::array<double, 3>, 10>& nodes);

}  // namespace holdfast::exact
