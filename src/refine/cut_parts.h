// Cuts a mesh into parts, and finds the work left after the parts are joined.
#pragma once

#include <memory>
#include <vector>

#include "mesh/parallel.h"
#include "refine/cuts.h"
#include "refine/parts.h"

namespace holdfast {

/// Cuts these tetrahedra into parts. No parts if more than the share `most_at_cuts` of the tetrahedra would
/// be at interfaces, as with a vertex that half of the tetrahedra have.
[[nodiscard]] std::unique_ptr<Parts> cut_into_parts(const VolumeData& volume, const std::vector<Tet>& tets,
                                                    const Cuts& cuts, double most_at_cuts,
                                                    const Threads& threads);

/// All tetrahedra inside in as many parts as their number asks for; none where it is small.
[[nodiscard]] std::unique_ptr<Parts> cut_evenly(const VolumeData& volume, const Threads& threads);

/// Joins the parts. Returns the tetrahedra near interfaces between them, if any, as the next parts to work
/// on, to do what the interfaces forbade. They are cut again if they are many.
[[nodiscard]] std::unique_ptr<Parts> join_and_cut_again(Parts& parts, const Threads& threads);

}  // namespace holdfast
