// Parts that were closed, and are so no longer.
#pragma once

#include <span>

#include "repair/state.h"

namespace holdfast::repairing {

/// The first part that had no side with a single facet and has one now, or no facet at all; no_index if there
/// is none. `part` is
/// that of each facet of the input, which `before` is.
[[nodiscard]] Index opened_part(const State& before, const State& after, std::span<const Index> part);

}  // namespace holdfast::repairing
