// Relocation of free vertices one by one (paper §6.4).
#pragma once

#include "untangle/tangle.h"
#include "untangle/watch.h"

namespace holdfast {

/// Moves the vertices of non-positive tetrahedra, worst ball first, as long as that lessens the deficit.
///
/// Where the ball has a kernel the vertex goes there: every tetrahedron at it is positive then. Else it goes
/// where the negative volume round it is least among: the point least behind the ball's faces; the mean of
/// its neighbours; the paper's P*, with several weights omega. Returns the number of moves.
std::size_t relocate(Tangle& tangle, Watch& watch);

}  // namespace holdfast
