// The connectivity of an input volume: its boundary, the fixed elements, its orientation.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "holdfast/types.h"
#include "untangle/tangle.h"

namespace holdfast {

struct Connectivity {
  std::vector<Tetrahedron> tets;  ///< the volume's in order, all turned alike
  std::vector<int> regions;       ///< one per tetrahedron
  std::vector<Index> component;   ///< of each tetrahedron: connected through faces
  std::size_t component_count = 0;
  std::size_t turned = 0;  ///< listed the other way round than in the volume
  std::vector<Triangle>
      outer_faces;  ///< of the boundary and between regions, that are not in the volume's facets
  Constraints constraints;
  std::string fault;  ///< one sentence where the connectivity is not that of a mesh; then the rest is void
};

/// Reads the connectivity; coordinates are not used. `fixed` are vertices that stay besides those of
/// constraints; they must be in range.
///
/// Tetrahedra that share a face should be on its two sides. Files list them in any orientation, so flooding
/// gives all of them the same one; `turn_outwards` decides which of the two.
[[nodiscard]] Connectivity read_connectivity(const Volume& volume, std::span<const Index> fixed);

/// Turns the components whose volume is negative (that of their boundary: it does not depend on free
/// vertices).
void turn_outwards(Connectivity& connectivity, std::span<const Point> vertices);

/// The volume's facets, then the outer faces, with the volume's segments. Vertices keep their numbers; the
/// free ones, which are not part of the boundary, are placed beyond it so that they meet nothing.
[[nodiscard]] Surface boundary_surface(const Volume& volume, const Connectivity& connectivity);

}  // namespace holdfast
