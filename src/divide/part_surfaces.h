// The surfaces of the parts of a labelled mesh: facets that border on a part, and interfaces.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "holdfast/divide.h"

namespace holdfast::division {

/// What a facet of a part's surface has in front and behind: the id of a region of the part, or nothing where
/// the part is not.
struct CutSurface {
  SurfacePart part;
  std::vector<FacetRegions> sides;  ///< one a facet of `part.surface`
};

/// One a label, in order. `marker` is that of interfaces. Facets are turned so that the outside of the part
/// is in front, and inside so that winding numbers are positive where there are such.
[[nodiscard]] std::vector<CutSurface> part_surfaces(const Volume& volume,
                                                    std::span<const Neighbours> neighbours,
                                                    std::span<const Index> labels, int marker);

}  // namespace holdfast::division
