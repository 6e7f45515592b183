// Fictitious cuts replace the missing facets at a segment with fewer than two (paper §6.3.2;
// docs/concepts.md, Fictitious cuts).
#pragma once

#include <array>
#include <vector>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// The boundary A', ..., B' of a polygon that lies in a plane through A'B' and is a fan of mesh faces
/// round P, none of them of a constraint.
using CutPath = std::vector<Vertex>;

/// Makes fictitious cuts at P, inside a segment with chain neighbours `ends`: as many as facets are missing
/// from two.
///
/// Way 1: a vertex v for which (A',P,v) and (P,B',v) are mesh faces; the one that splits the angle most
/// evenly. Way 2, always possible: in a half-plane through AB that avoids the facet and all link vertices,
/// a vertex is put close to P and joined to A' and B' by chains. Vertices made so are appended to `created`.
[[nodiscard]] std::vector<CutPath> fictitious_cuts(TetMesh& mesh, Vertex p, const std::array<Vertex, 2>& ends,
                                                   std::vector<Vertex>& created);

}  // namespace holdfast
