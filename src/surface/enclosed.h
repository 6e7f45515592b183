// Surface layer: how many regions a valid surface encloses, by counting alone.
#pragma once

#include <cstddef>

#include "surface/complex.h"

namespace holdfast {

/// The number of bounded regions of space without the facets of a valid complex.
///
/// By Alexander duality it is the rank of the second homology group over Z/2: the dimension of the sets of
/// facets in which every segment has an even number of facets. Such a set holds, with one facet, all those
/// that follow across segments of two facets, and none of those that can be peeled off from borders. So the
/// unknowns are few, patches between segments of three facets or more, with an equation for each of these.
[[nodiscard]] std::size_t enclosed_regions(const SegmentTable& table);

}  // namespace holdfast
