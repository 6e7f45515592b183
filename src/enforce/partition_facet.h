// Partition of a missing facet (paper §5.2; docs/concepts.md has the proof).
#pragma once

#include "enforce/facet_section.h"

namespace holdfast {

struct FacetPieces {
  std::vector<std::array<Vertex, 3>> faces;
  /// Vertices strictly inside the facet: new ones, and Steiner points that an earlier relocation happened to
  /// put there.
  std::vector<Vertex> inner;
  std::size_t added = 0;  ///< new points
};

/// Makes the facet a union of mesh faces by splitting every edge that pierces its inside, and sets the
/// facet bits of those faces. The new points lie exactly in the facet's plane, at A + u (B - A) + v (C - A)
/// with short dyadic u, v, near the piercing edge: somewhere in the kernel of its shell.
/// Every new edge has an end in the plane, so one pass is enough (docs/concepts.md).
FacetPieces partition_facet(TetMesh& mesh, const FacetFrame& frame);

}  // namespace holdfast
