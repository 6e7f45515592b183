// Sides with one facet.
#pragma once

#include <cstddef>

#include "repair/state.h"

namespace holdfast::repairing {

/// Number of sides with one facet. Vertices at the same place are one.
[[nodiscard]] std::size_t open_sides(const State& state);

}  // namespace holdfast::repairing
