// Writes legacy VTK files, ASCII (VTK User's Guide, "VTK File Formats").
#include "io/mesh_sets.h"
#include "io/vtk_cells.h"

namespace holdfast::io {
namespace {

/// A name as a word: as in VTK, %XX replaces characters that are not graphic ASCII.
std::string encoded(std::string_view name) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string result;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte > ' ' && byte < 127 && c != '"' && c != '%') {
      result += c;
      continue;
    }
    result += '%';
    result += kDigits[byte / 16];
    result += kDigits[byte % 16];
  }
  return result;
}

void write_names(AtomicWriter& out, const Names& names) {
  const VtkFields fields = vtk_fields(names);
  if (fields.empty()) return;
  out << "FIELD FieldData " << std::uint64_t{fields.size()} << '\n';
  for (const auto& [name, values] : fields) {
    out << encoded(name) << " 2 " << std::uint64_t{values.size()} << " int\n";
    for (const auto& [id, dimension] : values) out << id << ' ' << dimension << '\n';
  }
}

/// Calls `visit(type, nodes, kind, region, marker)` for every cell.
template <typename Visit>
void visit_cells(const Volume& volume, Visit&& visit) {
  const bool second = is_second_order(volume);
  for (std::size_t i = 0; i < volume.tetrahedra.size(); ++i)
    visit(second ? VtkCell::quadratic_tetrahedron : VtkCell::tetrahedron,
          tetrahedron_nodes(volume, i, kVtkEdges), 3, tag_of(volume.regions, i), 0);
  for (std::size_t i = 0; i < volume.facets.size(); ++i)
    visit(second ? VtkCell::quadratic_triangle : VtkCell::triangle, facet_nodes(volume, i), 2, 0,
          tag_of(volume.facet_markers, i));
  for (std::size_t i = 0; i < volume.segments.size(); ++i)
    visit(second ? VtkCell::quadratic_edge : VtkCell::line, segment_nodes(volume, i), 1, 0,
          tag_of(volume.segment_markers, i));
}

/// Writes an array of integers by cell.
template <typename Value>
void write_array(AtomicWriter& out, const Volume& volume, std::string_view name, Value&& value) {
  out << "SCALARS " << name << " int 1\nLOOKUP_TABLE default\n";
  visit_cells(volume, [&](VtkCell, const Nodes&, int kind, int region, int marker) {
    out << value(kind, region, marker) << '\n';
  });
}

}  // namespace

void write_vtk(AtomicWriter& out, const Volume& volume) {
  const std::uint64_t cells = volume.tetrahedra.size() + volume.facets.size() + volume.segments.size();
  const std::uint64_t per_cell[] = {is_second_order(volume) ? 11u : 5u, is_second_order(volume) ? 7u : 4u,
                                    is_second_order(volume) ? 4u : 3u};
  const std::uint64_t numbers = per_cell[0] * volume.tetrahedra.size() + per_cell[1] * volume.facets.size() +
                                per_cell[2] * volume.segments.size();
  const std::uint64_t points = node_count(volume);
  out << "# vtk DataFile Version 3.0\nHoldfast\nASCII\nDATASET UNSTRUCTURED_GRID\n";
  out << "POINTS " << points << " double\n";
  for (std::size_t i = 0; i < points; ++i) {
    const Point& p = node(volume, i);
    out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  }
  out << "CELLS " << cells << ' ' << numbers << '\n';
  visit_cells(volume, [&](VtkCell, const Nodes& nodes, int, int, int) {
    out << std::uint64_t{nodes.count};
    for (const Index v : nodes) out << ' ' << v;
    out << '\n';
  });
  out << "CELL_TYPES " << cells << '\n';
  visit_cells(volume,
              [&](VtkCell type, const Nodes&, int, int, int) { out << static_cast<int>(type) << '\n'; });
  // Behind the cells: Gmsh refuses a file with fields before the points, and meshio reads them only here.
  write_names(out, volume.names);
  out << "CELL_DATA " << cells << '\n';
  // The region comes first: viewers colour by the first array, and meshio keeps it if it keeps only one.
  write_array(out, volume, "region", [](int, int region, int) { return region; });
  write_array(out, volume, "marker", [](int, int, int marker) { return marker; });
  write_array(out, volume, "kind", [](int kind, int, int) { return kind; });
  if (volume.vertex_markers.empty()) return;
  out << "POINT_DATA " << points << "\nSCALARS marker int 1\nLOOKUP_TABLE default\n";
  for (std::size_t i = 0; i < points; ++i)
    out << (i < volume.vertex_markers.size() ? volume.vertex_markers[i] : 0) << '\n';
}

}  // namespace holdfast::io
