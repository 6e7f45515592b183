// A vertex of any position, with doubles or without, into a mesh that has no constraints yet.
#pragma once

#include <cstdint>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// Puts a vertex that is in no tetrahedron into those that hold it, inside or on their boundary: they give
/// way to its cone, which is positive. Not the Delaunay tetrahedra, but no predicate is needed beyond orient.
/// Returns false, with the mesh as it was, where none is found that holds it inside the hull. `random` is the
/// state of the walk that looks for it.
bool insert_vertex(TetMesh& mesh, Vertex v, std::uint32_t& random);

}  // namespace holdfast
