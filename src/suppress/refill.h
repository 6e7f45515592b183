// Filling a grown cavity again without a Steiner point, or with it at a better place.
#pragma once

#include <functional>
#include <random>

#include "mesh/tet_mesh.h"
#include "suppress/small_polyhedron.h"

namespace holdfast {

struct Growth {
  int attempts = 3;  ///< each from the ball again, another way
  int steps = 8;     ///< tetrahedra that an attempt may add
  PolyhedronOptions search{};
};

/// The functions below require that the Steiner points are the vertices from `first_free` on and lie on no
/// constraint. Other Steiner points inside a cavity are removed with p.

/// Removes p by filling its ball and some tetrahedra round it again. Returns whether p is gone.
bool refill_without(TetMesh& mesh, Vertex p, Vertex first_free, const Growth& growth,
                    std::mt19937_64& random);

/// Takes the balls of p and of a neighbour together and fills them again, grown by at most `steps`
/// tetrahedra: without either, or with p alone at a place in doubles that sees all of it. Returns whether the
/// neighbour is gone.
bool merge(TetMesh& mesh, Vertex p, Vertex neighbour, Vertex first_free, int steps,
           const PolyhedronOptions& search);

/// Gives p a position in doubles: its ball grows across the faces that leave least room until the kernel
/// holds one. At most `steps` tetrahedra are added. Returns whether p has one.
bool round_with_neighbours(TetMesh& mesh, Vertex p, Vertex first_free, int steps);

using Tell = std::function<void()>;
/// The same with complete searches (mesh/double_in_kernel.h), which are slow: `tell` is called before each.
bool round_completely(TetMesh& mesh, Vertex p, Vertex first_free, int steps, const Tell& tell);
/// The same with a ball that grows at random.
bool round_completely(TetMesh& mesh, Vertex p, Vertex first_free, int steps, const Tell& tell,
                      std::mt19937_64& random);

}  // namespace holdfast
