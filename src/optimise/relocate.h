// Relocation of one free vertex to where the worst tetrahedron of its ball is best.
#pragma once

#include <random>
#include <vector>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// Moves vertex p, which no constraint holds, so that the worst Q of its ball falls. The search is a guess
/// in floating point; each step is taken only where every tetrahedron stays positive, decided exactly. `ball`
/// is the ball of p. Returns whether p was moved.
bool relocate(TetMesh& mesh, Vertex p, std::span<const Tet> ball, std::mt19937_64& random);

}  // namespace holdfast
