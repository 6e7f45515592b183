// Patches: facets of different parts that lie on each other, which get common triangles.
#pragma once

#include <span>
#include <vector>

#include "repair/led_sides.h"
#include "repair/part_facets.h"

namespace holdfast::repairing {

struct Patches {
  std::vector<Index> close;                ///< facets that come near another part
  std::vector<std::vector<Index>> facets;  ///< of each patch, ascending
  std::vector<Index> of;                   ///< by facet its patch, or no_index
};

/// What lies within `gap` of another part, and what of it lies on each other. `rounding` is how far from its
/// plane a facet may be for rounding alone.
[[nodiscard]] Patches find_patches(const PartFacets& facets, double gap, double rounding, const Step& step);

/// A triangle in the place of some facets.
struct Pasted {
  Triangle corners;
  std::vector<Index> facets;  ///< ascending
};

/// The common triangles of all patches, with the pieces of their sides. Of each facet exactly these are sides
/// of an odd number of its triangles. The furthest distance of a triangle's corner from a facet that it
/// stands for is noted in `most`.
[[nodiscard]] std::vector<Pasted> paste(const PartFacets& facets, const LedSides& sides,
                                        const Patches& patches, double gap, double rounding, const Step& step,
                                        double& most);

}  // namespace holdfast::repairing
