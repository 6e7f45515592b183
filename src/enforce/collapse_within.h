// Elimination without a new point: a partition point collapses along its own constraint.
#pragma once

#include <span>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// Collapses P onto one of `candidates`, vertices of P's own constraint that are joined to P: its neighbours
/// on the segment's chain, or corners of the facet's polygon round P. Possible where one sees the whole link
/// of P strictly but for the faces that it is a corner of; the fattest result wins.
///
/// The constraint faces at P become those of the fan from the candidate. They stay in their planes, and
/// each keeps its turn there, since the tetrahedron on it stays positive and its apex does not move: so
/// they still cover what they covered. `segment`: the chain neighbours of P, which become an edge.
/// Returns whether P is gone.
bool collapse_within(TetMesh& mesh, Vertex p, std::span<const Vertex> candidates,
                     std::span<const std::array<Vertex, 2>> segment);

/// The corners of the facet faces round P.
[[nodiscard]] std::vector<Vertex> facet_neighbours(TetMesh& mesh, Vertex p);

}  // namespace holdfast
