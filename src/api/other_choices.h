// Other random orders of the whole mesh, where its worst element is far worse than the facets require
// (docs/decisions/other-orders-where-an-element-is-far-worse-than-the-triangles-ask-for.md).
#pragma once

#include "api/attempts.h"
#include "api/input.h"
#include "holdfast/holdfast.h"

namespace holdfast {

/// Tries other orders, in half of the time that is left, and leaves the best mesh in `result`, which is that
/// of the attempts and done on entry.
void try_other_choices(Attempts& attempts, Input& input, const Options& options, Limits& limits,
                       const Result& result);

}  // namespace holdfast
