// Rounds the vertices of facets in trouble to the points of a grid.
#pragma once

#include "repair/settle.h"
#include "repair/state.h"

namespace holdfast::repairing {

/// Moves each corner of the elements in trouble to its nearest grid point, with all other vertices whose
/// nearest grid point is the same: one vertex is left there. `cell` is a power of two. Facets may lose their
/// area, or cross. Returns the largest distance by which a vertex was moved, rounded up.
///
/// L. Valque and S. Lazard, "Removing self-intersections in 3D meshes while preserving floating-point
/// coordinates", 2024, have the idea: once little is in trouble, and points are rounded more coarsely than
/// they are written, the facets still in trouble soon have no new points beside them.
double snap_to_grid(State& state, const Trouble& trouble, double cell);

}  // namespace holdfast::repairing
