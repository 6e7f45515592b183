// The part of each tetrahedron of the coarse mesh.
#pragma once

#include <span>
#include <vector>

#include "divide/bisection.h"
#include "holdfast/holdfast.h"

namespace holdfast::division {

/// The label of a tetrahedron is the cell of its centre. But a tetrahedron that sticks out gets the label of
/// most of its neighbours, which makes interfaces smaller and flatter. Labels are consecutive; cells without
/// tetrahedra have none.
[[nodiscard]] std::vector<Index> label(const Volume& volume, std::span<const Neighbours> neighbours,
                                       const Bisection& cells);

}  // namespace holdfast::division
