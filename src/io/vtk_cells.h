// What the VTK formats have in common: cell types and the arrays that tell the cells apart.
//
// Holdfast writes tetrahedra first, then facets as triangles, then segments as lines, with three
// integers a cell: "region" (of a tetrahedron, else 0), "marker" (of a facet or segment, else 0) and
// "kind" (the cell's dimension: 3 tetrahedron, 2 facet, 1 segment); and where vertices are marked, an integer
// "marker" a point.
#pragma once

#include <cstdint>

#include "io/formats.h"

namespace holdfast::io {

/// Cell types of vtkCellType.h.
enum class VtkCell : std::uint8_t {
  vertex = 1,
  poly_vertex = 2,
  line = 3,
  poly_line = 4,
  triangle = 5,
  triangle_strip = 6,
  polygon = 7,
  pixel = 8,
  quad = 9,
  tetrahedron = 10,
};

/// The cells of a volume in the order in which they are written.
template <typename Visit>
void visit_vtk_cells(const Volume& volume, Visit&& visit) {
  for (std::size_t i = 0; i < volume.tetrahedra.size(); ++i)
    visit(VtkCell::tetrahedron, std::span<const Index>(volume.tetrahedra[i]), 3, tag_of(volume.regions, i),
          0);
  for (std::size_t i = 0; i < volume.facets.size(); ++i)
    visit(VtkCell::triangle, std::span<const Index>(volume.facets[i]), 2, 0, tag_of(volume.facet_markers, i));
  for (std::size_t i = 0; i < volume.segments.size(); ++i)
    visit(VtkCell::line, std::span<const Index>(volume.segments[i]), 1, 0, tag_of(volume.segment_markers, i));
}

[[nodiscard]] inline std::size_t vtk_cell_count(const Volume& volume) {
  return volume.tetrahedra.size() + volume.facets.size() + volume.segments.size();
}

/// Whether Holdfast reads an array of this name, or writes it for viewers alone.
[[nodiscard]] inline bool is_known_array(std::string_view name) {
  return name == "region" || name == "marker" || name == "kind";
}

/// Cells as they come from a file, not yet checked.
struct VtkGrid {
  std::vector<Point> points;
  std::vector<std::uint8_t> types;         ///< VtkCell, one a cell
  std::vector<std::int64_t> ends;          ///< where each cell's corners end
  std::vector<std::int64_t> connectivity;  ///< the corners of all cells
  std::vector<int> regions, markers;       ///< empty, or one a cell
  std::vector<int> point_markers;          ///< empty, or one a point
  std::vector<std::string> other_arrays;   ///< names of arrays that have no place in a mesh
};

/// Appends the cells of a part, which names the same points.
void append_cells(VtkGrid& grid, const VtkGrid& part);

/// The mesh of a grid. Polygons are fanned where they are convex. Throws FileError with the cell's
/// number for types that cannot be used, and for corners that do not exist.
[[nodiscard]] MeshData mesh_of(const Source& source, VtkGrid&& grid);

}  // namespace holdfast::io
