// Sides that one facet has.
#pragma once

#include <cstddef>

#include "repair/state.h"

namespace holdfast::repairing {

/// How many there are. Vertices at the same place are one.
[[nodiscard]] std::size_t open_sides(const State& state);

}  // namespace holdfast::repairing
