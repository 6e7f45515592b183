// Writes legacy VTK files, ASCII (VTK User's Guide, "VTK File Formats").
#include "io/vtk_cells.h"

namespace holdfast::io {

void write_vtk(AtomicWriter& out, const Volume& volume) {
  const std::uint64_t cells = vtk_cell_count(volume);
  const std::uint64_t numbers =
      5 * volume.tetrahedra.size() + 4 * volume.facets.size() + 3 * volume.segments.size();
  out << "# vtk DataFile Version 3.0\nHoldfast\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS "
      << std::uint64_t{volume.vertices.size()} << " double\n";
  for (const Point& p : volume.vertices) out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  out << "CELLS " << cells << ' ' << numbers << '\n';
  visit_vtk_cells(volume, [&](VtkCell, std::span<const Index> corners, int, int, int) {
    out << std::uint64_t{corners.size()};
    for (const Index corner : corners) out << ' ' << corner;
    out << '\n';
  });
  out << "CELL_TYPES " << cells << '\n';
  visit_vtk_cells(volume, [&](VtkCell type, std::span<const Index>, int, int, int) {
    out << static_cast<int>(type) << '\n';
  });
  out << "CELL_DATA " << cells << '\n';
  // The region first: it is what viewers colour by, and what meshio keeps where it keeps one array.
  out << "SCALARS region int 1\nLOOKUP_TABLE default\n";
  visit_vtk_cells(volume,
                  [&](VtkCell, std::span<const Index>, int, int region, int) { out << region << '\n'; });
  out << "SCALARS marker int 1\nLOOKUP_TABLE default\n";
  visit_vtk_cells(volume,
                  [&](VtkCell, std::span<const Index>, int, int, int marker) { out << marker << '\n'; });
  out << "SCALARS kind int 1\nLOOKUP_TABLE default\n";
  visit_vtk_cells(volume, [&](VtkCell, std::span<const Index>, int kind, int, int) { out << kind << '\n'; });
  if (volume.vertex_markers.empty()) return;
  out << "POINT_DATA " << std::uint64_t{volume.vertices.size()}
      << "\nSCALARS marker int 1\nLOOKUP_TABLE default\n";
  for (const int marker : volume.vertex_markers) out << marker << '\n';
}

}  // namespace holdfast::io
