// The validator of the mesh's invariants (tet_mesh.h), which MeshEditor runs after every operation in debug
// builds.
#pragma once

#include <span>
#include <string>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// The first broken invariant of a tetrahedron and its faces' neighbours, or an empty string.
[[nodiscard]] std::string find_fault(const TetMesh& mesh, Tet t);

/// The first broken invariant of the whole mesh, segment bits round whole shells included.
[[nodiscard]] std::string find_fault(const TetMesh& mesh);

/// Throws std::logic_error if one of `tets`, or anything in the mesh, is at fault.
void throw_on_fault(const TetMesh& mesh, std::span<const Tet> tets);
void throw_on_fault(const TetMesh& mesh);

}  // namespace holdfast
