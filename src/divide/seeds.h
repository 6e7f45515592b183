// Seeds by which a part's surface alone determines which of its enclosed regions belong to the part.
#pragma once

#include <span>

#include "divide/part_surfaces.h"

namespace holdfast::division {

/// Fills the surface with `mesh` and puts a seed into each bounded region: a seed of the part's region, by
/// `sides`, with the largest size that a seed of `wanted` gives it, or a hole. The outcome is that of `mesh`.
[[nodiscard]] Outcome add_seeds(CutSurface& surface, std::span<const RegionSeed> wanted, double size,
                                const Options& options);

}  // namespace holdfast::division
