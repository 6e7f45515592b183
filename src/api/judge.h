// Judging the options of a call before any work is done.
#pragma once

#include "holdfast/holdfast.h"

namespace holdfast {

/// Throws std::invalid_argument for options that make no sense or do not suit the complex, as far as that can
/// be told without a mesh.
void require_sensible(const Complex& complex, const Options& options);

/// Throws std::invalid_argument for holes and region seeds that lie on a facet, or where it takes no mesh to
/// see that no bounded region is: `choose_regions` sees to the others. Indices must be in range and
/// coordinates finite. `step` is called now and then, and may throw.
void require_well_placed(const Complex& complex, const Options& options, const std::function<void()>& step);

}  // namespace holdfast
