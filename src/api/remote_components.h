// Components of a volume that are too small, or too large, to have field points at the scale of the others.
#pragma once

#include <functional>

#include "holdfast/holdfast.h"
#include "mesh/parallel.h"

namespace holdfast {

using Mesher = std::function<Result(const Complex&, const Options&)>;

/// A component is a part of space between facets. If its extent is out of the range in which sizes can be
/// computed when the largest coordinate is near one, it becomes a complex of its own with its own scale, and
/// gets field points from `mesh`. `result` is that of the complex and the options, which ask for field
/// points. A component for which this is impossible stays as it is. `threads` are polled. Throws Interrupted
/// if a call of `mesh` is interrupted.
void mesh_remote_components(const Complex& complex, const Options& options, const Threads& threads,
                            const Mesher& mesh, Result& result);

}  // namespace holdfast
