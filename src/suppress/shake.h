// Random flips round a Steiner point: another mesh as good as the last, where the point may go.
#pragma once

#include <functional>
#include <random>

#include "mesh/tet_mesh.h"
#include "recover/flipper.h"

namespace holdfast {

/// Tries to remove `edges` edges in the ball of p and a few tetrahedra round it, by flips that touch no
/// constraint. No vertex comes, goes or moves.
void shake(TetMesh& mesh, Flipper& flipper, Vertex p, int edges, std::mt19937_64& random);

/// The same near four vertices, of tetrahedra that `may_change` alone, and of those that they give way to.
void shake(TetMesh& mesh, Flipper& flipper, const TetMesh::Corners& corners, int edges,
           const std::function<bool(Tet)>& may_change, std::mt19937_64& random);

}  // namespace holdfast
