// Inserts missing segments one after the other, by swaps or by partition.
#pragma once

#include "holdfast/plane.h"
#include "plane/draft.h"

namespace holdfast::plane {

/// Makes every segment of a closed Delaunay triangulation a constraint, and the hull if asked for. By swaps,
/// the triangles end constrained Delaunay if this is asked for. Counts go to the report of `result`, and
/// chains of pieces to its `intermediate` if the run stops early. Returns false if segments meet outside
/// common ends.
[[nodiscard]] bool lay_segments(Draft& draft, const PlaneOptions& options, PlaneResult& result,
                                const Poll& poll);

}  // namespace holdfast::plane
