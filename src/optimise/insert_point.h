// Adds a point for a tetrahedron so flat that nothing else helps. The new elements are fit to compute with.
#pragma once

#include <vector>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// Fills a cavity round an edge of t anew from a point in the middle of its kernel, if all tetrahedra there
/// have a Q below `most` then. `created` receives them. The point is the last of the spare vertices, if such
/// are given. Returns it, or kNone.
Vertex insert_point(TetMesh& mesh, Tet t, Vertex first_free, double most, std::vector<Vertex>* spare,
                    std::vector<Tet>& created);

}  // namespace holdfast
