// Elements of second order in files: their mid-edge nodes are vertices of the file like all others.
#pragma once

#include <span>

#include "io/mesh_data.h"

namespace holdfast::io {

void add_second_order(MeshData& mesh, const Tetrahedron& corners, const std::array<Index, 6>& mids,
                      int region);
void add_second_order(MeshData& mesh, const Triangle& corners, const std::array<Index, 3>& mids, int marker);
void add_second_order(MeshData& mesh, const Segment& corners, Index mid, int marker);

/// Adds the side of a tetrahedron opposite a corner as a facet that faces outwards, with the nodes on its
/// edges if the tetrahedron has some.
void add_side(MeshData& mesh, Index tetrahedron, std::size_t opposite, int marker);

/// Marks nodes of an element that was added by its corners as non-corners: nodes of quadrangles of second
/// order and of elements of higher order, which a mesh here cannot store.
void add_no_corners(MeshData& mesh, std::span<const Index> nodes);

/// Removes nodes that are not corners from the vertices; the others keep their order. They become `mid_nodes`
/// if `keep` is set and every tetrahedron, facet and segment has all of its mid-edge nodes and no others.
/// Otherwise they are left out, with a remark.
void settle_mid_nodes(MeshData& mesh, bool keep);

}  // namespace holdfast::io
