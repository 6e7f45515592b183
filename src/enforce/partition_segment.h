// Partition of a missing segment (paper §5.2, §6.1; docs/concepts.md has the proof).
#pragma once

#include <vector>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// Makes AB a chain of mesh edges by inserting a point wherever it pierces a face or an edge, and sets the
/// segment bits of the chain. Each point slides along AB to a short dyadic parameter for which its ball
/// stays positive, so it is A + t (B - A) exactly.
///
/// Returns the chain A, P1, ..., Pn, B. An interior vertex is a new one, or a Steiner point that an earlier
/// relocation happened to put exactly on AB. Throws std::logic_error if an input vertex
/// (index < first_free) lies inside AB, which valid input rules out.
std::vector<Vertex> partition_segment(TetMesh& mesh, Vertex a, Vertex b, Vertex first_free);

/// The same for any two vertices whose connecting line crosses no constraint, without segment bits.
std::vector<Vertex> partition_line(TetMesh& mesh, Vertex a, Vertex b);

}  // namespace holdfast
