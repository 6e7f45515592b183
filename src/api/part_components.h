// The parts of one surface.
#pragma once

#include <vector>

#include "holdfast/types.h"

namespace holdfast {

/// For each facet its part, numbered in the order of first facets: a connected component, by the vertices
/// that facets name. A component of negative volume is a cavity and belongs to the smallest component of
/// positive volume whose box contains its own, if there is one. Indices may be out of range.
[[nodiscard]] std::vector<Index> parts_by_components(const Surface& surface);

}  // namespace holdfast
