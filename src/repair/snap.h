// Vertices of later parts put on earlier ones.
#pragma once

#include <span>

#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

/// What vertices may be put on.
enum class SnapTo { vertices, all };

/// Moves vertices of parts that are at most `tolerance` away from an earlier part: onto its nearest vertex,
/// else onto a side, else onto a facet (if these count, too), each vertex once. A move that makes a part
/// invalid by itself is not done. `part` tells the part of each facet, which `state` has as the input has
/// them. Returns the largest distance, rounded up.
double snap(State& state, std::span<const Index> part, SnapTo to, double tolerance, const Step& step,
            const Threads& threads);

}  // namespace holdfast::repairing
