// Parts of facets that are thinner than doubles can tell.
#pragma once

#include "mesh/parallel.h"
#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

/// Of a valid surface. Where the new points on both sides of a thin part of a facet of the input stand at the
/// same doubles, the part is nothing but a line, and where nothing else has it, the corner beyond is lost.
/// Such lines become facets of some last bits' width, if the surface stays valid: that is decided exactly.
/// `given`: the input; `most`: how far the surface is from it. Returns how far it is then, rounded up.
[[nodiscard]] double keep_strips(State& state, const State& given, double most, const Step& step,
                                 const Threads& threads);

}  // namespace holdfast::repairing
