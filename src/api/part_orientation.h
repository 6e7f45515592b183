// How the facets of a pasted surface are turned against those of the parts.
#pragma once

#include <span>

#include "holdfast/paste.h"
#include "holdfast/types.h"

namespace holdfast {

/// Sets `turned` of facets that were folded where sides bent: their normals say the opposite of what their
/// neighbours say. A part that was consistently oriented stays so: its facets that meet at sides of just two
/// of them get one orientation, that of the larger area. `part` holds the part of each facet of `joined`.
void orient_folds(const Complex& joined, std::span<const Index> part, PasteResult& result);

}  // namespace holdfast
