// The triangles of the regions that are kept, as refinement takes and leaves them.
#pragma once

#include "holdfast/plane.h"
#include "plane/refine.h"
#include "plane/regions.h"

namespace holdfast::plane {

/// Only kept triangles. Their marks are their regions, and they end at constraints.
[[nodiscard]] Triangles kept_part(const Triangles& mesh, const Regions& regions,
                                  const std::vector<bool>& kept);

/// Gives a refined mesh the pieces of segments, in their direction and with their markers, which points on
/// them have, too; so have the points of the input at their ends, if none of these came with a marker.
void cut_segments(const Plane& plane, const Refined& refined, PlaneMesh& mesh);

}  // namespace holdfast::plane
