// The constraints of a run that ends before regions are found, in the vertex numbers of the delivered volume.
#pragma once

#include <span>

#include "api/boundary.h"
#include "holdfast/intermediate.h"

namespace holdfast {

/// `number`: of each vertex of the mesh in the volume.
[[nodiscard]] Intermediate intermediate_of(const Attempt& attempt, const BoxMesh& box,
                                           std::span<const Index> number);

}  // namespace holdfast
