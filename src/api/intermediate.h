// The constraints of a run that ends before regions are found, in vertex numbers of the delivered volume.
#pragma once

#include <span>

#include "api/boundary.h"
#include "holdfast/intermediate.h"

namespace holdfast {

/// `number` has the volume's number of each vertex of the mesh.
[[nodiscard]] Intermediate intermediate_of(const Attempt& attempt, const BoxMesh& box,
                                           std::span<const Index> number);

}  // namespace holdfast
