// Flipping a Steiner point down to fewer neighbours (paper §6.4): four are one tetrahedron without it.
#pragma once

#include "mesh/tet_mesh.h"
#include "recover/flipper.h"

namespace holdfast {

/// Removes edges at p by flips as long as that helps, clearing the way up to `depth` flips deep, with about
/// `budget` sign tests an edge. Returns whether p has fewer neighbours now.
bool lower_degree(TetMesh& mesh, Flipper& flipper, Vertex p, int depth, std::size_t budget);

}  // namespace holdfast
