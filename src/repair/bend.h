// Sides and facets that pass a vertex nearby are led through it.
#pragma once

#include <span>

#include "repair/settle.h"
#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

/// Leads the sides and facets of what is in trouble through those of `vertices` (ascending) that they pass at
/// most `gap` away, unless a facet would be bent by more than `room` in all. Ends early where there are more
/// than `most_facets`. Returns the largest distance by
/// which anything was bent, rounded up.
double bend(State& state, const Trouble& trouble, std::span<const Index> vertices, double gap, double room,
            std::size_t most_facets, const Step& step);

}  // namespace holdfast::repairing
