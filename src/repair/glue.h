// Parts of a surface that have facets in common.
#pragma once

#include <span>
#include <vector>

#include "repair/state.h"

namespace holdfast::repairing {

/// Facets of different parts with the same corners (places) become one, the first of them, with the parents
/// of all. `part` tells the part of each facet of the input. Facets that one part has twice stay two.
void glue(State& state, std::span<const Index> part);

}  // namespace holdfast::repairing
