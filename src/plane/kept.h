// The triangles of the kept regions, before and after refinement.
#pragma once

#include "holdfast/plane.h"
#include "plane/refine.h"
#include "plane/regions.h"

namespace holdfast::plane {

/// Only the kept triangles, bounded by constraints. Their marks are their regions.
[[nodiscard]] Triangles kept_part(const Triangles& mesh, const Regions& regions,
                                  const std::vector<bool>& kept);

/// Gives a refined mesh the pieces of segments, with the direction and marker of each segment. Points on a
/// segment get its marker, and so do its ends if no point of the input came with a marker.
void cut_segments(const Plane& plane, const Refined& refined, PlaneMesh& mesh);

}  // namespace holdfast::plane
