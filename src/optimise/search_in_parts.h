// The search of a large mesh in parts, on several threads (mesh/in_place_parts.h).
#pragma once

#include <vector>

#include "optimise/search.h"

namespace holdfast {

/// Works on the bad ones of `tets`, the tetrahedra of the search: first in parts, each with its share of the
/// budget, then near the cuts, on the calling thread. The rest waits in the search, or has been given up.
/// `seed` is the seed of the random orders. The number of threads makes no difference. Returns false, with
/// the mesh unchanged, if there are few tetrahedra, or too many would be at the cuts.
bool work_off_in_parts(Search& search, const std::vector<Tet>& tets, Ways::Points points, std::uint64_t seed,
                       const Threads& threads, Monitor& monitor);

}  // namespace holdfast
