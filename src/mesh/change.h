// What one operation does to the tetrahedra, worked out before anything is touched.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// A tetrahedron to come. A neighbour is a face of the mesh outside the change, or one of the new tetrahedra.
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

/// The old tetrahedra go, the new ones come, and both fill the same space. Nothing is left to fail: all
/// neighbours and flags are known, and the new tetrahedra are positive.
struct Change {
  std::span<const Tet> old_tets;
  std::span<const NewTet> new_tets;
  /// A vertex that all new tetrahedra hold keeps the first of them as incident(); others keep the last.
  Vertex centre = kNone;
};

}  // namespace holdfast
