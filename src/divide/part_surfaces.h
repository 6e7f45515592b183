// The surfaces of the parts of a labelled mesh: facets that border on a part, and interfaces.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "holdfast/divide.h"

namespace holdfast::division {

/// The two sides of a facet of a part's surface, in front and behind: the id of a region of the part, or
/// nothing outside the part.
struct CutSurface {
  SurfacePart part;
  std::vector<FacetRegions> sides;  ///< one per facet of `part.surface`
};

/// One surface for each label, in order. `marker` is the marker of interfaces. Facets on the part's boundary
/// have its outside in front. Facets inside are oriented so that winding numbers are positive, if there are
/// winding numbers.
[[nodiscard]] std::vector<CutSurface> part_surfaces(const Volume& volume,
                                                    std::span<const Neighbours> neighbours,
                                                    std::span<const Index> labels, int marker);

}  // namespace holdfast::division
