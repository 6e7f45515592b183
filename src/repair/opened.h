// Finds parts that were closed and are open now.
#pragma once

#include <span>

#include "repair/state.h"

namespace holdfast::repairing {

/// The first part that had no side with a single facet and now has one, or has no facet at all; no_index if
/// there is none. `before` is the input, and `part` holds the part of each of its facets.
[[nodiscard]] Index opened_part(const State& before, const State& after, std::span<const Index> part);

}  // namespace holdfast::repairing
