// Glues parts of a surface along common facets.
#pragma once

#include <span>
#include <vector>

#include "repair/state.h"

namespace holdfast::repairing {

/// Facets of different parts with the same corners (places) become one: the first of them, with the parents
/// of all. `part` holds the part of each facet of the input. If one part has a facet twice, both stay.
void glue(State& state, std::span<const Index> part);

}  // namespace holdfast::repairing
