// Elements of second order in files: their nodes on edges are vertices there like all others.
#pragma once

#include <span>

#include "io/mesh_data.h"

namespace holdfast::io {

void add_second_order(MeshData& mesh, const Tetrahedron& corners, const std::array<Index, 6>& mids,
                      int region);
void add_second_order(MeshData& mesh, const Triangle& corners, const std::array<Index, 3>& mids, int marker);
void add_second_order(MeshData& mesh, const Segment& corners, Index mid, int marker);

/// Says that nodes of an element that has been added by its corners are none: those of quadrangles of second
/// order and of elements of higher order, which nothing here has a place for.
void add_no_corners(MeshData& mesh, std::span<const Index> nodes);

/// Takes nodes that are no corners out of the vertices; the others keep their order. They become
/// `mid_nodes` if `keep` and if every tetrahedron, facet and segment has them all and no others, and are left
/// out, with a remark, otherwise.
void settle_mid_nodes(MeshData& mesh, bool keep);

}  // namespace holdfast::io
