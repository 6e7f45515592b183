// What stands where a run ends before regions are found, in numbers of the volume that it delivers.
#pragma once

#include <span>

#include "api/boundary.h"
#include "holdfast/intermediate.h"

namespace holdfast {

/// `number`: of each vertex of the mesh in the volume.
[[nodiscard]] Intermediate intermediate_of(const Attempt& attempt, const BoxMesh& box,
                                           std::span<const Index> number);

}  // namespace holdfast
