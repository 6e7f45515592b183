// Elements of second order in files: their nodes on edges are vertices there like all others.
#pragma once

#include "io/mesh_data.h"

namespace holdfast::io {

void add_second_order(MeshData& mesh, const Tetrahedron& corners, const std::array<Index, 6>& mids,
                      int region);
void add_second_order(MeshData& mesh, const Triangle& corners, const std::array<Index, 3>& mids, int marker);
void add_second_order(MeshData& mesh, const Segment& corners, Index mid, int marker);

/// Takes nodes that lie on edges alone out of the vertices; the others keep their order. They become
/// `mid_nodes` if `keep` and if every tetrahedron, facet and segment has them all, and are left out, with a
/// remark, otherwise.
void settle_mid_nodes(MeshData& mesh, bool keep);

}  // namespace holdfast::io
