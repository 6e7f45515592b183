// Restores parts of facets that are too thin for doubles.
#pragma once

#include "mesh/parallel.h"
#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

/// For a valid surface. If the new points on both sides of a thin part of an input facet have the same
/// doubles, the part is only a line; if no other part has this line, the corner beyond it is lost. Such lines
/// become facets some last bits wide if the surface stays valid, which an exact test decides. `given`: the
/// input; `most`: the distance of the surface from it. Returns the new distance, rounded up.
[[nodiscard]] double keep_strips(State& state, const State& given, double most, const Step& step,
                                 const Threads& threads);

}  // namespace holdfast::repairing
