// Relocation of free vertices one by one (paper §6.4).
#pragma once

#include "untangle/tangle.h"
#include "untangle/watch.h"

namespace holdfast {

/// Moves the vertices of non-positive tetrahedra, worst ball first, as long as that reduces the deficit.
///
/// If the ball has a kernel the vertex moves there: then every tetrahedron at it is positive. Otherwise it
/// moves to the place with the least negative volume round it among: the point least behind the ball's faces;
/// the mean of its neighbours; the paper's P*, with several weights omega. Returns the number of moves.
std::size_t relocate(Tangle& tangle, Watch& watch);

}  // namespace holdfast
