// Elimination without a new point: a partition point collapses along its own constraint.
#pragma once

#include <span>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// Collapses P onto one of `candidates`, vertices of P's own constraint that are joined to P: its neighbours
/// on the segment's chain, or corners of the facet's polygon round P. This is possible for a candidate that
/// strictly sees all faces of P's link except those of which it is a corner. The fattest result wins.
///
/// The constraint faces at P become the faces of the fan from the candidate. They stay in their planes and
/// keep their orientation, because the tetrahedron on each face stays positive and its apex does not move. So
/// they still cover the same part of the constraint. `segment`: the chain neighbours of P, which become an
/// edge.
/// Returns whether P is gone.
bool collapse_within(TetMesh& mesh, Vertex p, std::span<const Vertex> candidates,
                     std::span<const std::array<Vertex, 2>> segment);

/// The corners of the facet faces round P.
[[nodiscard]] std::vector<Vertex> facet_neighbours(TetMesh& mesh, Vertex p);

}  // namespace holdfast
