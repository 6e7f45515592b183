// Checks the options of a call before any work is done.
#pragma once

#include "holdfast/holdfast.h"
#include "surface/complex.h"
#include "surface/places.h"

namespace holdfast {

/// Throws std::invalid_argument for options that make no sense or do not suit the complex, as far as this can
/// be decided without a mesh.
void require_sensible(const Complex& complex, const Options& options);

/// Throws std::invalid_argument for holes and region seeds that lie on a facet or in no bounded region, for
/// seeds that give one region two ids, and for seeds in a region with a hole. The complex must be valid for
/// the regions to be right; `table` and `names` belong to it. `step` is called now and then, and may throw.
void require_well_placed(const Complex& complex, const SegmentTable& table, const Options& options,
                         const VertexNames& names, const std::function<void()>& step);

}  // namespace holdfast
