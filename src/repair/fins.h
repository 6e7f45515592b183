// Thin facets that are attached to a surface by some of their sides.
#pragma once

#include "repair/state.h"

namespace holdfast::repairing {

/// If a thin part between sheets is folded, its two sides become one facet, a fin, which is attached to the
/// surface and encloses nothing. Fins are removed from their free sides inwards, under two conditions: no
/// point of a fin is further from the sides that stay than anything was displaced before, or than the
/// distance of the first joining; and in the end no side with a single facet is left. So a surface keeps its
/// own borders. Every facet of the input (`given`) keeps a part, and at each corner the sides from there;
/// every vertex in use stays in use. Returns the largest such distance, rounded up.
double drop_fins(State& state, const State& given, double displaced);

}  // namespace holdfast::repairing
