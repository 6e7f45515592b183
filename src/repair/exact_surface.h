// The exact arrangement in the form that the caller gets.
#pragma once

#include "arrange/arrange.h"
#include "holdfast/repair.h"
#include "repair/state.h"

namespace holdfast::repairing {

/// The arrangement of a state that still has the input's vertices and whose facets have these parents.
[[nodiscard]] ExactSurface exact_surface(const arrange::Arrangement& arrangement, const Parents& of_state);

/// The same for a valid surface, which is its own arrangement.
[[nodiscard]] ExactSurface exact_surface(const State& valid, const Parents& of_state);

}  // namespace holdfast::repairing
