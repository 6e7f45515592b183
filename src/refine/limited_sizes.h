// Where the surface limits sizes, for a report: on how much of a volume, and at which facets (docs/sizes.md).
#pragma once

#include <vector>

#include "mesh/parallel.h"
#include "refine/volume_data.h"
#include "size/size_function.h"

namespace holdfast {

struct LimitedSizes {
  /// Where a facet limits sizes more than others do.
  struct AtFacet {
    Index facet;
    double wanted, bearable;  ///< where their ratio is the largest
    Point place;
    double volume;  ///< part of all
  };
  double volume = 0,
         asked_volume = 0;      ///< parts of all; the second where the user's sizes are the ones wanted
  std::vector<AtFacet> facets;  ///< by volume, the most first
};

/// Asks at the centroid of each tetrahedron of a finished mesh. Nothing is limited with a metric or with
/// bounds on volumes.
[[nodiscard]] LimitedSizes limited_sizes(const VolumeData& volume, const SizeFunction& sizes,
                                         const Threads& threads);

}  // namespace holdfast
