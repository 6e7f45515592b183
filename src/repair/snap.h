// Puts vertices of later parts on earlier parts.
#pragma once

#include <span>

#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

/// The elements that vertices may be put on.
enum class SnapTo { vertices, all };

/// Moves vertices at most `tolerance` away from an earlier part onto its nearest vertex, else onto a side,
/// else onto a facet (if sides and facets count), each vertex once. A move is left out if it makes a part
/// invalid by itself. `part` holds the part of each facet; `state` has the facets of the input. Returns the
/// largest distance moved, rounded up.
double snap(State& state, std::span<const Index> part, SnapTo to, double tolerance, const Step& step,
            const Threads& threads);

}  // namespace holdfast::repairing
