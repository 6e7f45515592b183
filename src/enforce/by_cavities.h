// A missing facet by its two cavities (recover/facet_cavities.h), with Steiner points in its plane moved
// away.
#pragma once

#include <functional>

#include "enforce/steiner_points.h"
#include "mesh/tet_mesh.h"
#include "recover/facet_cavities.h"

namespace holdfast {

/// Whether the facet is a mesh face now, with its bit set. `finish` makes everything stand in a cavity.
/// Points that it adds go to `steiner`. `tell` is called now and then, and may throw.
bool recover_by_cavities(TetMesh& mesh, FacetCavities& cavities, const Triangle& facet,
                         SteinerPoints& steiner, const std::function<void()>& tell,
                         const FacetCavities::Finish& finish);

}  // namespace holdfast
