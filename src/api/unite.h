// The union of the parts of a surface: facets that have the same on both sides go.
#pragma once

#include "holdfast/repair.h"
#include "repair/holes.h"
#include "repair/rounding.h"

namespace holdfast {

/// Drops facets of a valid surface with material on both sides, or on none. Material is what
/// `Keep::automatic` keeps of any connected component of the input by itself; what belongs to several counts
/// once. `input` is the surface that the state's parents name. Returns an outcome other than done where the
/// regions could not be found within the limits. `holes` are what of them is left.
[[nodiscard]] Outcome unite(const Complex& input, repairing::State& state, repairing::Holes& holes,
                            const RepairOptions& options, const Step& step);

}  // namespace holdfast
