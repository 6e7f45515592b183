// Untangling (paper §6.4): the steps in their order, until every tetrahedron is positive.
#pragma once

#include "untangle/refill.h"
#include "untangle/tangle.h"
#include "untangle/watch.h"

namespace holdfast {

struct UntangleStats {
  std::size_t rounds = 0, swapped = 0;
  RefillStats refill;
};

/// Relocation, swaps and smoothing take turns as long as that reduces the deficit; the rest is then refilled.
///
/// Why positive is enough. Let M be the mesh as an abstract complex, f its map to space, linear on each
/// tetrahedron. For a point x off the images of faces, the sum of the signs of the tetrahedra whose images
/// hold x is the degree of f at x, which is the winding number of f(boundary of M) about x: it depends on the
/// boundary alone. Where the boundary is an embedded surface with M on its inner side, the degree is 1 inside
/// and 0 outside. If all signs are +1, it counts the tetrahedra that hold x: one inside, none outside. So no
/// two overlap, and together they fill the boundary's inside. (The same for each region by itself.)
UntangleStats make_positive(Tangle& tangle, const CavityFiller* filler, Watch& watch);

}  // namespace holdfast
