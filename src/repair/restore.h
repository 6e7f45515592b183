// Vertices of the input that became another, back where they were.
#pragma once

#include <span>

#include "mesh/parallel.h"
#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

/// Of a valid surface. A vertex of the input that no longer stands where it was (`before`) gets a place in a
/// facet or a side beside it, which is led through it, or takes some of the facets at the vertex that it
/// became, if the surface stays valid: that is decided exactly. What finds none within some tries stays
/// moved, and so does all where that is more than a quarter of the vertices: the surface is there twice.
/// Returns the largest distance by which anything was bent, rounded up.
double restore(State& state, std::span<const Point> before, const Step& step, const Threads& threads);

}  // namespace holdfast::repairing
