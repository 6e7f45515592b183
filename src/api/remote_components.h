// Components of a volume that are too small, or too large, beside the others to have field points with them.
#pragma once

#include <functional>

#include "holdfast/holdfast.h"
#include "mesh/parallel.h"

namespace holdfast {

using Mesher = std::function<Result(const Complex&, const Options&)>;

/// Components, parts of space between facets, whose extent is out of the range in which sizes can be computed
/// when the largest coordinate is near one: each becomes a complex of its own, which has a scale of its own,
/// and the field points that `mesh` gives it. `result` is that of the complex and the options, which ask for
/// field points. Where a component cannot be had so, it stays as it is. `threads` are polled. Throws
/// Interrupted where a call of `mesh` is.
void mesh_remote_components(const Complex& complex, const Options& options, const Threads& threads,
                            const Mesher& mesh, Result& result);

}  // namespace holdfast
