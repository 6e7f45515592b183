// The borders of a surface as loops.
#pragma once

#include <vector>

#include "holdfast/types.h"

namespace holdfast::repairing {

/// Vertices in turn, none twice, against the facets at its sides as far as these agree.
using Loop = std::vector<Index>;

/// Loops of sides that have one facet. Every side is in one loop at most; a path that does not close is in
/// none.
[[nodiscard]] std::vector<Loop> border_loops(const Complex& surface);

}  // namespace holdfast::repairing
