// Numbers that follow a space-filling curve, so that what is near in space is near in memory: most of the
// time of work on a large mesh is waiting for memory otherwise.
#pragma once

#include <vector>

#include "classify/regions.h"
#include "mesh/tet_mesh.h"

namespace holdfast {

/// Renumbers tetrahedra, and the vertices from `first` on, along a Morton curve. `region_of`, by slot, and
/// `sizes`, by vertex unless empty, follow.
void order_along_curve(TetMesh& mesh, Vertex first, std::vector<RegionId>& region_of,
                       std::vector<double>& sizes);

}  // namespace holdfast
