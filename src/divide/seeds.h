// Seeds that tell, with a part's surface alone, what of the space that it encloses belongs to the part.
#pragma once

#include <span>

#include "divide/part_surfaces.h"

namespace holdfast::division {

/// Fills the surface with `mesh` and puts a seed into each bounded region: of the part's region that `sides`
/// tells, with the largest size that a seed of `wanted` gives it, or a hole. The outcome is that of `mesh`.
[[nodiscard]] Outcome add_seeds(CutSurface& surface, std::span<const RegionSeed> wanted, double size,
                                const Options& options);

}  // namespace holdfast::division
