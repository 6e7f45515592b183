// The exact arrangement as it is told to the caller.
#pragma once

#include "arrange/arrange.h"
#include "holdfast/repair.h"
#include "repair/state.h"

namespace holdfast::repairing {

/// The arrangement of a state whose vertices are still the input's.
[[nodiscard]] ExactSurface exact_surface(const State& before, const arrange::Arrangement& arrangement);

/// Of a valid surface, which is its own arrangement.
[[nodiscard]] ExactSurface exact_surface(const State& valid);

}  // namespace holdfast::repairing
