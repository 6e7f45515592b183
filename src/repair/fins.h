// Thin facets that hang on a surface by some of their sides.
#pragma once

#include "repair/state.h"

namespace holdfast::repairing {

/// Where a thin part between sheets is folded, its two sides become one facet, which hangs on the surface and
/// encloses nothing. Such facets go from their free sides inwards where no point of one is further from the
/// sides that stay than anything was displaced before, or than what is joined first of all, and where in the
/// end no side is left that one facet has. So a surface keeps its own borders. Every facet of the input keeps
/// a part and, at each corner, the sides that lead from there; every vertex of it that is used stays so.
/// `given`: the input. Returns the largest such distance, rounded up.
double drop_fins(State& state, const State& given, double displaced);

}  // namespace holdfast::repairing
