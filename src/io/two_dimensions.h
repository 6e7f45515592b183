// Meshes of the plane in formats of solvers that tell two dimensions from three.
#pragma once

#include <cstddef>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::io {

/// Whether the cells of a mesh are its triangles, and whether these also lie in the plane z = 0, which
/// formats hold as a mesh of two dimensions.
[[nodiscard]] inline bool has_cells_of_triangles(const Volume& volume) {
  return volume.tetrahedra.empty() && !volume.facets.empty();
}
[[nodiscard]] bool is_in_plane(const Volume& volume);

/// The segments of a mesh of triangles: those that it has, and unmarked the edges of one triangle that are
/// none, since solvers need the boundary whole.
struct Sides {
  std::vector<Segment> segments;
  std::vector<int> markers;       ///< one per segment
  std::vector<bool> on_boundary;  ///< of exactly one triangle

  explicit Sides(const Volume& volume);
};

}  // namespace holdfast::io
