// The changes of one operation to the tetrahedra, computed before the mesh is changed.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// A new tetrahedron. A neighbour is a face of the mesh outside the change, or one of the new tetrahedra.
struct NewTet {
  TetMesh::Corners corners;
  TetMesh::Neighbours neighbours;
  Flags flags;
};

/// Marks a neighbour that is a new tetrahedron.
inline constexpr Face kNewFace = 0x80000000u;
/// Face i of the k-th new tetrahedron, as a neighbour.
[[nodiscard]] inline constexpr Face new_face(std::size_t k, std::size_t i) {
  return static_cast<Face>(4 * k + i) | kNewFace;
}
[[nodiscard]] inline constexpr bool is_new_face(Face f) { return (f & kNewFace) != 0; }
[[nodiscard]] inline constexpr std::size_t number_of_new(Face f) { return (f & ~kNewFace) >> 2; }

/// Replaces old tetrahedra by new ones that fill the same space. Applying it cannot fail: all neighbours and
/// flags are known, and the new tetrahedra are positive.
struct Change {
  std::span<const Tet> old_tets;
  std::span<const NewTet> new_tets;
  /// A vertex of all new tetrahedra gets the first of them as incident(); other vertices get the last of
  /// theirs.
  Vertex centre = kNone;
};

}  // namespace holdfast
