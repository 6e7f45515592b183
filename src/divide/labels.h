// Which part a tetrahedron of the coarse mesh belongs to.
#pragma once

#include <span>
#include <vector>

#include "divide/bisection.h"
#include "holdfast/holdfast.h"

namespace holdfast::division {

/// Of each tetrahedron the cell of its centre, but that those which stick out go to the part that has most of
/// their sides: interfaces get smaller and flatter so. Numbers are consecutive; cells without tetrahedra have
/// none.
[[nodiscard]] std::vector<Index> label(const Volume& volume, std::span<const Neighbours> neighbours,
                                       const Bisection& cells);

}  // namespace holdfast::division
