// Steiner points that no mesh of their part of space can do without.
#pragma once

#include "mesh/tet_mesh.h"

namespace holdfast {

/// Whether it is proven that p cannot go: that the component of p, all that can be reached from it without
/// crossing a facet, has no mesh without inner points, and p is the only one in it. Proven only of small
/// components, by exhaustive search (small_polyhedron.h); of others the answer is no.
///
/// p is a Steiner point and lies on no constraint, like all vertices from `first_free` on.
[[nodiscard]] bool is_needed(TetMesh& mesh, Vertex p, Vertex first_free);

}  // namespace holdfast
