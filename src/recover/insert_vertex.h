// Inserts a vertex at any position, in doubles or exact, into a mesh that has no constraints yet.
#pragma once

#include <cstdint>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// Inserts a vertex that is in no tetrahedron. The tetrahedra that contain it, inside or on their boundary,
/// are replaced by its cone, which is positive. The result is not Delaunay, but needs only the predicate
/// orient. Returns false, with the mesh unchanged, if no tetrahedron inside the hull is found that contains
/// the vertex. `random` is the state of the walk that looks for it.
bool insert_vertex(TetMesh& mesh, Vertex v, std::uint32_t& random);

}  // namespace holdfast
