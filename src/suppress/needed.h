// Steiner points that every mesh of their component needs.
#pragma once

#include "mesh/tet_mesh.h"

namespace holdfast {

/// Whether p is proven to be needed: the component of p (all that can be reached without crossing a facet)
/// has no mesh without inner points, and p is its only inner point. This is proven only for small components,
/// by exhaustive search (small_polyhedron.h); for others the answer is no.
///
/// p is a Steiner point and lies on no constraint, like all vertices from `first_free` on.
[[nodiscard]] bool is_needed(TetMesh& mesh, Vertex p, Vertex first_free);

}  // namespace holdfast
