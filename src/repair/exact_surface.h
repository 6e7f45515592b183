// The exact arrangement as it is told to the caller.
#pragma once

#include "arrange/arrange.h"
#include "holdfast/repair.h"
#include "repair/state.h"

namespace holdfast::repairing {

/// The arrangement of a state whose vertices are still the input's, and whose facets have these parents.
[[nodiscard]] ExactSurface exact_surface(const arrange::Arrangement& arrangement, const Parents& of_state);

/// Of a valid surface, which is its own arrangement.
[[nodiscard]] ExactSurface exact_surface(const State& valid, const Parents& of_state);

}  // namespace holdfast::repairing
