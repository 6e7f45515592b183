// Hexahedra, prisms and pyramids, which become tetrahedra.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/mesh_data.h"

namespace holdfast::io {

/// Adds a cell as tetrahedra of a region. Its corners come first among its nodes: of a pyramid (5 corners)
/// the base and the apex, of a prism (6) a triangle and the one across, of a hexahedron (8) a quadrangle and
/// the one across, each with its corners in turn; the other nodes are no corners. A corner may be there
/// twice, as programs write it that have no prisms.
///
/// Each quadrangle gets the diagonal at its vertex of the lowest index, so that cells fit together whatever
/// their kinds and order (Dompierre, Labbé, Vallet, Camarero 1999), and the tetrahedra join the cell's lowest
/// vertex to the triangles of the faces that it is not in. They are positive as far as the cell allows and
/// plain arithmetic tells: which way round a file lists its corners does not matter. The vertices must be
/// known.
void add_cell(MeshData& mesh, std::span<const Index> nodes, std::size_t corners, int region);

/// Of a cell of first or second order, by the number of its nodes: 5 or 13, 6 or 15 or 18, 8 or 20 or 27;
/// else 0.
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

/// The triangles of a side of such a cell, by the rule of `add_cell`, or none for a side that there is not.
/// Sides count from 0 as Abaqus and CalculiX number them from 1.
[[nodiscard]] std::vector<Triangle> side_of_cell(std::span<const Index> corners, std::size_t side);

/// Gives the quadrangles that became facets the diagonals that the cells beside them have, if there are any.
void settle_quadrangles(MeshData& mesh);

/// "2 hexahedra, 1 prism and 1 pyramid", of those that were added.
[[nodiscard]] std::string words_of(const MeshData::Cells& cells);

}  // namespace holdfast::io
