// Segments made edges by swaps (paper §2.2), and constrained Delaunay triangles by swaps (Lawson 1977).
#pragma once

#include "numbers/random.h"
#include "plane/segments.h"

namespace holdfast::plane {

/// Swaps edges that the segment ab crosses, at random, until it crosses none; `crossed` is its passage. Edges
/// that were swapped, seen from both sides, are added to `swapped`. The number of swaps.
std::size_t swap_in(Triangles& mesh, const Points& points, Vertex a, Vertex b,
                    const std::vector<EdgeCode>& crossed, numbers::Random& random,
                    std::vector<EdgeCode>& swapped);

/// Swaps edges that are no constraints until the circle of each triangle has no corner of a neighbour inside
/// (but behind constraints), beginning with the edges of the triangles of `pending`. The number of swaps.
std::size_t swap_to_delaunay(Triangles& mesh, const Points& points, std::vector<EdgeCode> pending,
                             const Poll& poll);
/// The same for all edges.
std::size_t swap_to_delaunay(Triangles& mesh, const Points& points, const Poll& poll);

}  // namespace holdfast::plane
