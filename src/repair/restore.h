// Puts input vertices that became others back where they were.
#pragma once

#include <span>

#include "mesh/parallel.h"
#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

/// For a valid surface. An input vertex that left its place (`before`) goes back in one of two ways: a facet
/// or a side beside the place is led through it, or it takes some facets of the vertex that it became. The
/// surface must stay valid, which an exact test decides. A vertex that finds no way within some tries stays
/// moved. If more than a quarter of the vertices were moved, the surface is duplicated, and all of them stay
/// moved. Returns the largest distance by which anything was bent, rounded up.
double restore(State& state, std::span<const Point> before, const Step& step, const Threads& threads);

}  // namespace holdfast::repairing
