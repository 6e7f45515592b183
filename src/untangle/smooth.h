// Relocation of many vertices at once: foldover-free maps.
//
// V. Garanzha, I. Kaporin, L. Kudryavtseva, F. Protais, N. Ray, D. Sokolov, "Foldover-free maps in 50 lines
// of code", ACM Trans. Graph. 40 (2021). Written from the paper.
#pragma once

#include "untangle/tangle.h"
#include "untangle/watch.h"

namespace holdfast {

/// Moves the free vertices within so many rings of tetrahedra of the non-positive ones, until all at them are
/// positive or nothing is gained any more. Ends at the best positions met, by the exact deficit; returns
/// whether they are better than those before.
bool smooth(Tangle& tangle, unsigned rings, Watch& watch);

}  // namespace holdfast
