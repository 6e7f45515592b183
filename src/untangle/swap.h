// Exchange of tetrahedra in a tangled mesh: face swaps, edge removal (paper §6.4).
#pragma once

#include "untangle/tangle.h"
#include "untangle/watch.h"

namespace holdfast {

/// Removes edges and faces of non-positive tetrahedra as long as that lessens the deficit. Returns how many.
///
/// In a tangled mesh signs do not keep an exchange from making an edge or a face that exists already (paper,
/// Fig. 12), so each must be new: then the connectivity stays that of a mesh, whatever the signs.
std::size_t swap_tets(Tangle& tangle, Watch& watch);

}  // namespace holdfast
