// Suppressing a Steiner point by collapse, and recentring one that has to stay (design §2.5, §2.7).
#pragma once

#include "mesh/tet_mesh.h"

namespace holdfast {

/// Collapses a Steiner point, strictly off every constraint, onto a vertex of its link that sees the whole
/// link. Returns whether one does; then p is gone.
bool collapse_vertex(TetMesh& mesh, Vertex p);

/// Moves a Steiner point to the centre of its ball's kernel, in doubles where doubles reach inside.
/// Returns whether it moved.
bool recentre_vertex(TetMesh& mesh, Vertex p);

}  // namespace holdfast
