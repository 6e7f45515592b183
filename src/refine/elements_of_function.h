// Whether a function of the user, of sizes or of metrics, asks for more elements than any mesh can have.
#pragma once

#include "refine/volume_data.h"
#include "size/size_function.h"

namespace holdfast {

/// Whether it asks for more regular elements than `most`, as far as can be told before there are any: in a
/// tetrahedron the coarsest counts of what it asks for at the corners, the centre and the middles of edges,
/// so that fine places between coarse ones count for nothing. Never without such a function.
[[nodiscard]] bool asks_for_more_than(double most, const SizeFunction& sizes, const VolumeData& volume);

}  // namespace holdfast
