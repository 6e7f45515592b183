// The search of a large mesh in parts, on several threads (mesh/in_place_parts.h).
#pragma once

#include <vector>

#include "optimise/search.h"

namespace holdfast {

/// Works off the bad ones of `tets`, those of the search, each part with its share of the budget; then what
/// is near the cuts, on the calling thread. What is left waits in the search, or has been given up. `seed` is
/// that of the random orders. The threads make no difference. Returns false, with the mesh as it was, where
/// there are few, or too many would be at the cuts.
bool work_off_in_parts(Search& search, const std::vector<Tet>& tets, Ways::Points points, std::uint64_t seed,
                       const Threads& threads, Monitor& monitor);

}  // namespace holdfast
