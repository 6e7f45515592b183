// The triangles of one polygon, or of a facet of several outlines, independent of the first corner.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "plane/given_points.h"
#include "plane/sweep.h"

namespace holdfast::plane {

using Corners3 = std::array<Vertex, 3>;

/// Constrained Delaunay triangles of what a closed walk winds round, oriented as the walk, with every point
/// on the walk as a corner. The walk may touch itself, and may pass a bridge to a hole twice, once each way.
/// Returns nullopt if its sides cross or overlap otherwise, or if it winds round a place more than once or in
/// both directions. `points` are distinct and all on the walk, and consecutive ones of the walk differ.
[[nodiscard]] std::optional<std::vector<Corners3>> triangles_of_walk(const GivenPoints& points,
                                                                     std::span<const Vertex> walk,
                                                                     const Poll& poll);

/// Constrained Delaunay triangles of all that edges enclose, except the regions of holes, counterclockwise,
/// with points on no edge as corners, too. Returns nullopt if points coincide, edges meet other than in
/// common ends, or a hole lies on an edge. No edge may occur twice.
[[nodiscard]] std::optional<std::vector<Corners3>> triangles_of_outlines(const GivenPoints& points,
                                                                         const std::vector<Ends>& edges,
                                                                         const GivenPoints& holes,
                                                                         const Poll& poll);

}  // namespace holdfast::plane
