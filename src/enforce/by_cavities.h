// Recovers a missing facet by its two cavities (recover/facet_cavities.h), after moving Steiner points out of
// its plane.
#pragma once

#include <functional>

#include "enforce/steiner_points.h"
#include "mesh/tet_mesh.h"
#include "recover/facet_cavities.h"

namespace holdfast {

/// Returns whether the facet is now a mesh face, with its bit set. `finish` makes everything stand in a
/// cavity. Points that it adds go to `steiner`. `tell` is called from time to time, and may throw.
bool recover_by_cavities(TetMesh& mesh, FacetCavities& cavities, const Triangle& facet,
                         SteinerPoints& steiner, const std::function<void()>& tell,
                         const FacetCavities::Finish& finish);

}  // namespace holdfast
