// Surface layer: isolated vertices.
#pragma once

#include <vector>

#include "holdfast/types.h"

namespace holdfast {

/// The vertices that no facet and no segment uses and that are not left out (places.h), in ascending order.
[[nodiscard]] std::vector<Index> isolated_vertices(const Complex& complex);

}  // namespace holdfast
