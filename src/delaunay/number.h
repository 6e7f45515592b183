// The numbering of a finished triangulation: the same whatever the order in which its cells were made.
//
// Cells without the ghost go first, by their highest vertex, then by the lowest of the other corners, then by
// the corner after that; ghosts follow in the same order among themselves. Corner 0 is the highest vertex,
// corner 1 the lowest other one, except in ghosts, whose corner 3 is the ghost. Since vertices are numbered
// along a curve, cells near in memory are near in space.
//
// How: the sites count the cells of each highest vertex, which gives the position of its first cell. One pass
// over the slots puts the cells there, giving the memory of the slots back on the way, and a second one sorts
// the few cells of each vertex.
#pragma once

#include <vector>

#include "delaunay/triangulation.h"
#include "mesh/parallel.h"
#include "mesh/tet_mesh.h"

namespace holdfast {

/// Corners, as points, of all cells without the ghost. The triangulation's cells are freed on the way.
[[nodiscard]] std::vector<Tetrahedron> finite_cells(Triangulation& triangulation, const Threads& threads);

/// All cells; corners are points, or kGhost. Those of the triangulation are freed on the way.
[[nodiscard]] std::vector<TetMesh::Cell> all_cells(Triangulation& triangulation, const Threads& threads);

}  // namespace holdfast
