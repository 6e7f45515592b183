// The triangles of one polygon, or of a facet of several outlines: the same ones whatever corner comes first.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "plane/given_points.h"
#include "plane/sweep.h"

namespace holdfast::plane {

using Corners3 = std::array<Vertex, 3>;

/// Constrained Delaunay triangles of what a closed walk winds round, turned as the walk is, with every point
/// on the walk as a corner. The walk may touch itself and pass a bridge to a hole twice, once each way.
/// Nothing where its sides cross or overlap otherwise, or where it winds round a place other than once in the
/// one direction that it has. `points` are at distinct places, all of them on the walk, which never stays at
/// one.
[[nodiscard]] std::optional<std::vector<Corners3>> triangles_of_walk(const GivenPoints& points,
                                                                     std::span<const Vertex> walk,
                                                                     const Poll& poll);

/// Constrained Delaunay triangles of all that edges enclose but the regions of holes, turned left, with
/// points on no edge as corners, too. Nothing where points are at one place or edges meet other than in
/// common ends, or where a hole lies on an edge. No edge may occur twice.
[[nodiscard]] std::optional<std::vector<Corners3>> triangles_of_outlines(const GivenPoints& points,
                                                                         const std::vector<Ends>& edges,
                                                                         const GivenPoints& holes,
                                                                         const Poll& poll);

}  // namespace holdfast::plane
