// Which parts a mesh is cut into, and what is left to do once they are joined.
#pragma once

#include <memory>
#include <vector>

#include "mesh/parallel.h"
#include "refine/cuts.h"
#include "refine/parts.h"

namespace holdfast {

/// These tetrahedra in the parts that the cuts make of them. None where more than the share `most_at_cuts` of
/// them would be at interfaces, as with a vertex that half of the tetrahedra have.
[[nodiscard]] std::unique_ptr<Parts> cut_into_parts(const VolumeData& volume, const std::vector<Tet>& tets,
                                                    const Cuts& cuts, double most_at_cuts,
                                                    const Threads& threads);

/// All tetrahedra inside in as many parts as their number asks for; none where it is small.
[[nodiscard]] std::unique_ptr<Parts> cut_evenly(const VolumeData& volume, const Threads& threads);

/// Joins the parts. Returns what is near interfaces between them, where there are any, as the next to be
/// worked on: what the interfaces forbade is made up for. It is cut again where it is large.
[[nodiscard]] std::unique_ptr<Parts> join_and_cut_again(Parts& parts, const Threads& threads);

}  // namespace holdfast
