// The union of the parts of a surface: drops facets with the same material on both sides.
#pragma once

#include "holdfast/repair.h"
#include "repair/holes.h"
#include "repair/rounding.h"

namespace holdfast {

/// Drops facets of a valid surface with material on both sides or on none. Material is what `Keep::automatic`
/// keeps of some connected component of the input by itself, or of several that have a common border in the
/// state; overlaps count once. A component inside another one that faces the other way is a cavity of it.
/// `input` is the surface to which the state's parents refer. `holes` becomes what is left of the fillings.
void unite(const Complex& input, repairing::State& state, repairing::Holes& holes, const Step& step,
           const Threads& threads);

}  // namespace holdfast
