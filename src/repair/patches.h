// Patches: facets of different parts that lie on each other and get common triangles.
#pragma once

#include <span>
#include <vector>

#include "repair/led_sides.h"
#include "repair/part_facets.h"

namespace holdfast::repairing {

struct Patches {
  std::vector<Index> close;                ///< facets that come near another part
  std::vector<std::vector<Index>> facets;  ///< of each patch, ascending
  std::vector<Index> of;                   ///< the patch of each facet, or no_index
};

/// Finds the facets within `gap` of another part, and the patches among them. `rounding` is the distance that
/// rounding alone may put a facet off its plane.
[[nodiscard]] Patches find_patches(const PartFacets& facets, double gap, double rounding, const Step& step);

/// A triangle that replaces parts of some facets.
struct Pasted {
  Triangle corners;
  std::vector<Index> facets;  ///< ascending
};

/// The common triangles of all patches, with the pieces of their sides. For each facet, exactly these pieces
/// are sides of an odd number of its triangles. `most` receives the largest distance of a triangle's corner
/// from a facet that the triangle replaces.
[[nodiscard]] std::vector<Pasted> paste(const PartFacets& facets, const LedSides& sides,
                                        const Patches& patches, double gap, double rounding, const Step& step,
                                        double& most);

}  // namespace holdfast::repairing
