// How the mesh meets a facet: the section cells of its inside (paper §6.1, Fig. 9; docs/concepts.md).
#pragma once

#include <span>
#include <vector>

#include "mesh/tet_mesh.h"
#include "recover/pierce.h"

namespace holdfast {

/// A facet whose three sides are chains of mesh edges.
struct FacetFrame {
  std::array<Vertex, 3> corners;
  /// Consecutive vertices from corner i+1 to corner i+2 (mod 3), both included.
  std::array<std::vector<Vertex>, 3> sides;
};

struct FacetSection {
  std::vector<Face> faces;             ///< mesh faces inside the facet, one code each
  std::vector<PiercingEdge> piercing;  ///< each edge once
  std::vector<Vertex> inner;           ///< mesh vertices strictly inside the facet
  [[nodiscard]] bool stands() const { return piercing.empty(); }
};

/// Floods the facet's inside across tetrahedra that straddle its plane and across mesh faces in the plane. A
/// search from the sides alone would miss holes whose surroundings already stand.
///
/// The sides are mesh edges, so a section cell is either inside the facet or disjoint from it. The flood
/// therefore needs no point-in-triangle test: it starts inside and never crosses a side. Without piercing
/// edges the faces found cover the facet, since the flood reaches every cell of its connected inside.
[[nodiscard]] FacetSection facet_section(TetMesh& mesh, const FacetFrame& frame);

}  // namespace holdfast
