// The validator of the mesh's invariants (tet_mesh.h), run after every operation in debug builds.
#pragma once

#include <span>
#include <string>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// The first broken invariant of a tetrahedron and its faces' neighbours, or an empty string.
[[nodiscard]] std::string find_fault(const TetMesh& mesh, Tet t);

/// The first broken invariant of the whole mesh, segment bits round whole shells included.
[[nodiscard]] std::string find_fault(const TetMesh& mesh);

/// In builds with HOLDFAST_VALIDATE: throws std::logic_error if one of `tets` is at fault.
inline void validate_after_operation([[maybe_unused]] const TetMesh& mesh,
                                     [[maybe_unused]] std::span<const Tet> tets);

void throw_on_fault(const TetMesh& mesh, std::span<const Tet> tets);

inline void validate_after_operation(const TetMesh& mesh, std::span<const Tet> tets) {
#ifdef HOLDFAST_VALIDATE
  throw_on_fault(mesh, tets);
#else
  static_cast<void>(mesh);
  static_cast<void>(tets);
#endif
}

}  // namespace holdfast
