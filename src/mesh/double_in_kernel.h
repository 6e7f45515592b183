// Whether a kernel contains a point in doubles, however thin and slanted it is: a complete search.
#pragma once

#include <optional>
#include <span>

#include "mesh/tet_mesh.h"

namespace holdfast {

struct DoubleSearch {
  std::optional<Point> point;  ///< of the mesh's grid, strictly inside
  bool is_complete = true;     ///< without a point: there is none; false where too many parts were cut
};

/// Searches the points x with orient(f0, f1, f2, x) > 0 for all faces.
///
/// Between two powers of two the doubles form a lattice, so integer programming in three variables decides
/// (exact/integer_point.h; Lenstra 1983). A kernel that crosses powers of two, or zero, is cut there, unless
/// the coarsest of its lattices has a point inside, or the finest has none. All decisions are exact. The
/// search takes some hundred times as long as a look next to the kernel's centre.
[[nodiscard]] DoubleSearch find_double(const TetMesh& mesh, std::span<const std::array<Vertex, 3>> faces);

}  // namespace holdfast
