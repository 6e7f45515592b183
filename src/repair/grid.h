// Vertices rounded to the points of a grid, where a surface is in trouble.
#pragma once

#include "repair/settle.h"
#include "repair/state.h"

namespace holdfast::repairing {

/// The corners of what is in trouble go to the nearest point of a grid, and so do all other vertices that are
/// nearest to these points: one vertex is left at each. `cell` is a power of two. Facets may come to be of no
/// area, or cross. Returns the largest distance by which a vertex was moved, rounded up.
///
/// L. Valque and S. Lazard, "Removing self-intersections in 3D meshes while preserving floating-point
/// coordinates", 2024, have the idea: once little is in trouble, and points are rounded more coarsely than
/// they are written, what is left in trouble soon has none of its new points beside it.
double snap_to_grid(State& state, const Trouble& trouble, double cell);

}  // namespace holdfast::repairing
