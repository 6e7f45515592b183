// A vertex of any position, with doubles or without, into a mesh that has no constraints yet.
#pragma once

#include "mesh/tet_mesh.h"
#include "recover/pierce.h"

namespace holdfast {

/// Puts a vertex that is in no tetrahedron into those that hold it, inside or on their boundary: they give
/// way to its cone, which is positive. Not the Delaunay tetrahedra, but no predicate is needed beyond orient.
/// Returns false, with the mesh as it was, where no tetrahedron holds it inside the hull.
bool insert_vertex(TetMesh& mesh, Vertex v, Random& random);

}  // namespace holdfast
