// Shape of the elements inside, for reports: it decides nothing.
#pragma once

#include <vector>

#include "classify/regions.h"
#include "holdfast/holdfast.h"
#include "mesh/tet_mesh.h"

namespace holdfast {

/// Of the tetrahedra of the kept regions; `region_of` by slot.
[[nodiscard]] Report::Shape shape_of(const TetMesh& mesh, const std::vector<RegionId>& region_of,
                                     const std::vector<bool>& kept);

/// Lengths of their edges over the mean of the sizes at the ends (by vertex), as Report::Field has them.
[[nodiscard]] std::array<std::size_t, 24> edge_lengths_of(const TetMesh& mesh,
                                                          const std::vector<RegionId>& region_of,
                                                          const std::vector<bool>& kept,
                                                          const std::vector<double>& sizes);

}  // namespace holdfast
