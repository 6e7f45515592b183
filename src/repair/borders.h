// The borders of a surface as loops.
#pragma once

#include <vector>

#include "holdfast/types.h"

namespace holdfast::repairing {

/// The vertices of a loop in order, none twice, against the orientation of the facets at its sides where
/// these agree.
using Loop = std::vector<Index>;

/// Loops of sides with one facet. Every side is in at most one loop. Paths that do not close are in none.
[[nodiscard]] std::vector<Loop> border_loops(const Complex& surface);

}  // namespace holdfast::repairing
