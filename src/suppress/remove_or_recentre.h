// Suppresses a Steiner point, or recentres it if it has to stay (docs/concepts.md).
#pragma once

#include "mesh/tet_mesh.h"
#include "suppress/small_polyhedron.h"

namespace holdfast {

enum class Fate {
  collapsed,  ///< gone: a vertex of its link took its place
  filled,     ///< gone: its ball was filled again without it
  moved,      ///< to the centre of its ball's kernel
  stays,
};

/// Removes a Steiner point, strictly off every constraint, if possible; else moves it to the centre of its
/// ball's kernel, in doubles where doubles reach inside. `search` bounds the effort of filling the ball
/// again.
Fate remove_or_recentre(TetMesh& mesh, Vertex p, const PolyhedronOptions& search);

}  // namespace holdfast
