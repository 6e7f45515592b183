// Points that tell the regions of a surface.
#pragma once

#include "holdfast/paste.h"

namespace holdfast {

/// The pasted surface with a seed in each piece of a region, and a hole seed in each space that the parts
/// enclose and none contains; as it is if it has seeds itself, or no mesh in doubles. A mesh of this surface
/// by its seeds has the parts' regions. The points are found by a mesh, for which `options` gives limits and
/// threads. Throws as `mesh` does, and Interrupted.
[[nodiscard]] HOLDFAST_API Surface with_seeds(const PasteResult& pasted, const Options& options = {});

}  // namespace holdfast
