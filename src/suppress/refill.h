// Filling a grown cavity again without a Steiner point, or with it at a better place (design §2.7).
#pragma once

#include <random>

#include "mesh/tet_mesh.h"
#include "suppress/small_polyhedron.h"

namespace holdfast {

struct Growth {
  int attempts = 3;  ///< each from the ball again, another way
  int steps = 8;     ///< tetrahedra that an attempt may add
  PolyhedronOptions search{};
};

/// Removes p, which lies on no constraint, by filling its ball and some tetrahedra round it again. Returns
/// whether p is gone.
bool refill_without(TetMesh& mesh, Vertex p, const Growth& growth, std::mt19937_64& random);

/// Gives p, which lies on no constraint, a position in doubles: its ball grows across the faces that leave
/// least room until the kernel holds one. At most `steps` tetrahedra are added. Returns whether p has one.
bool round_with_neighbours(TetMesh& mesh, Vertex p, int steps);

}  // namespace holdfast
