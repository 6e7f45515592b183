// The numbering of a finished triangulation: the same whatever the order in which its cells were made.
//
// Cells go by their highest vertex, then by the lowest of the other corners, then by the corner after that.
// Corner 0 is the highest vertex, corner 1 the lowest other one; the ghost stays in slot 3. Since vertices
// are numbered along a curve, cells near in memory are near in space.
#pragma once

#include <vector>

#include "delaunay/triangulation.h"
#include "mesh/tet_mesh.h"

namespace holdfast {

/// Corners, as points, of all cells that have no ghost.
[[nodiscard]] std::vector<Tetrahedron> finite_cells(Triangulation& triangulation, unsigned threads);

/// Corners, as points or kGhost, and neighbours of all cells. The triangulation's cells are freed on the way.
struct NumberedCells {
  std::vector<TetMesh::Corners> corners;
  std::vector<TetMesh::Neighbours> neighbours;
};
[[nodiscard]] NumberedCells all_cells(Triangulation& triangulation, unsigned threads);

}  // namespace holdfast
