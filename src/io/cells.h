// Hexahedra, prisms and pyramids, which are cut into tetrahedra.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/mesh_data.h"

namespace holdfast::io {

/// Adds a cell as tetrahedra of a region. The first nodes are its corners: for a pyramid (5 corners) the
/// base, then the apex; for a prism (6) a triangle, then the opposite one; for a hexahedron (8) a quadrangle,
/// then the opposite one; each polygon with its corners in cyclic order. The remaining nodes are not corners.
/// A corner may be repeated, as in files of programs that have no prisms.
///
/// Each quadrangle gets the diagonal at its vertex of the lowest index, so that cells fit together whatever
/// their kinds and order (Dompierre, Labbé, Vallet, Camarero 1999). The tetrahedra join the cell's lowest
/// vertex to the triangles of the faces that do not contain it. They are positive as far as the cell allows
/// and plain arithmetic can show, whichever way round the file lists the corners. The vertices must already
/// be known.
void add_cell(MeshData& mesh, std::span<const Index> nodes, std::size_t corners, int region);

/// The number of corners of a cell of first or second order, by the number of its nodes: 5 or 13, 6 or 15 or
/// 18, 8 or 20 or 27; otherwise 0.
[[nodiscard]] constexpr std::size_t corners_of_cell(std::size_t nodes) {
  switch (nodes) {
    case 5:
    case 13:
      return 5;
    case 6:
    case 15:
    case 18:
      return 6;
    case 8:
    case 20:
    case 27:
      return 8;
    default:
      return 0;
  }
}

/// The triangles of a side of such a cell, by the rule of `add_cell`; empty if there is no such side. Sides
/// are numbered from 0, in the order in which Abaqus and CalculiX number them from 1.
[[nodiscard]] std::vector<Triangle> side_of_cell(std::span<const Index> corners, std::size_t side);

/// The tetrahedron in a hexahedron of repeated corners, as programs without tetrahedra write it:
/// (a b c d d d d d) or (a b c c d d d d). Nothing if it is no such tetrahedron.
[[nodiscard]] std::optional<Tetrahedron> degenerate_tetrahedron(std::span<const Index> hexahedron);

/// The triangles of a side of three or four corners, by the rule of `add_cell`.
[[nodiscard]] std::vector<Triangle> triangles_of_side(std::span<const Index> corners);

/// Gives the quadrangles that became facets the diagonals of the cells beside them, if there are any.
void settle_quadrangles(MeshData& mesh);

/// "2 hexahedra, 1 prism and 1 pyramid": the cells that were added.
[[nodiscard]] std::string words_of(const MeshData::Cells& cells);

}  // namespace holdfast::io
