// Quality of tetrahedra as the paper's §8 measures it; floating point, for reports and guidance only.
#pragma once

#include <array>
#include <span>

#include "holdfast/holdfast.h"

namespace holdfast {

/// Q = sqrt(6)/12 * longest edge / inradius: 1 for a regular tetrahedron, infinite for a flat one.
[[nodiscard]] double quality(const Point& a, const Point& b, const Point& c, const Point& d);

/// The six dihedral angles in degrees; NaN where a face has no area in doubles.
[[nodiscard]] std::array<double, 6> dihedral_angles(const Point& a, const Point& b, const Point& c,
                                                    const Point& d);

/// The best Q of a tetrahedron on a given triangle, with its apex above the incentre, where the inradius
/// for a given height is largest (paper §8: the "targeted quality" is that of the worst triangle).
[[nodiscard]] double best_quality_on(const Point& a, const Point& b, const Point& c);

/// Quality of a mesh against that of its boundary triangles.
[[nodiscard]] Report::Quality measure(const Volume& volume, std::span<const Triangle> facets);

}  // namespace holdfast
