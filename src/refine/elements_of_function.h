// Whether a function of the user, of sizes or of metrics, asks for more elements than any mesh can have.
#pragma once

#include "refine/volume_data.h"
#include "size/size_function.h"

namespace holdfast {

/// Whether the size function asks for more regular elements than `most`, estimated before there are any: in a
/// tetrahedron, the coarsest size at the corners, the centre and the midpoints of edges counts, so that fine
/// places between coarse ones are ignored. Always false without such a function.
[[nodiscard]] bool asks_for_more_than(double most, const SizeFunction& sizes, const VolumeData& volume);

}  // namespace holdfast
