// Segments that the mesh lacks come into it, one after the other, by swaps or by partition.
#pragma once

#include "holdfast/plane.h"
#include "plane/draft.h"

namespace holdfast::plane {

/// Makes every segment of a closed Delaunay triangulation a constraint, and the hull where it is asked for.
/// With swaps the triangles are constrained Delaunay in the end, if they are to be. Counts go to the report
/// of `result`, and chains of pieces to what it tells of a run that stops. False where segments meet other
/// than in common ends.
[[nodiscard]] bool lay_segments(Draft& draft, const PlaneOptions& options, PlaneResult& result,
                                const Poll& poll);

}  // namespace holdfast::plane
