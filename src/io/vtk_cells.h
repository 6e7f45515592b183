// What the VTK formats share: cell types and the arrays that distinguish cells.
//
// Holdfast writes tetrahedra first, then facets as triangles, then segments as lines, with these integers
// per cell: "region" (of a tetrahedron, else 0), "marker" (of a facet or segment, else 0) and "kind" (the
// cell's dimension: 3 tetrahedron, 2 facet, 1 segment); and, if vertices are marked, an integer "marker" per
// point.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "io/formats.h"
#include "io/labels.h"

namespace holdfast::io {

/// A field of a file: facets and segments are in another file beside it.
inline constexpr const char* kSurfaceBeside = "holdfast:surface_beside";
/// In a surface beside a volume: each point's index in the volume.
inline constexpr const char* kVolumeVertex = "volume_vertex";

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
  voxel = 11,
  hexahedron = 12,
  wedge = 13,
  pyramid = 14,
  quadratic_edge = 21,
  quadratic_triangle = 22,
  quadratic_quad = 23,
  quadratic_tetrahedron = 24,
  quadratic_hexahedron = 25,
  quadratic_wedge = 26,
  quadratic_pyramid = 27,
  biquadratic_quad = 28,
  triquadratic_hexahedron = 29,
  quadratic_linear_wedge = 31,
  biquadratic_wedge = 32,
  biquadratic_quadratic_hexahedron = 33,
  biquadratic_triangle = 34,
  triquadratic_pyramid = 37,
  lagrange_curve = 68,
  lagrange_triangle = 69,
  lagrange_quad = 70,
  lagrange_tetrahedron = 71,
  lagrange_hexahedron = 72,
  lagrange_wedge = 73,
  lagrange_pyramid = 74,
};

/// Arrays of a whole file: by name, pairs of an id and a dimension, as meshio takes them from Gmsh.
using VtkFields = std::map<std::string, std::vector<std::array<int, 2>>>;
[[nodiscard]] VtkFields vtk_fields(const Names& names);

/// Collects names from such arrays, which may be of any kind.
class VtkNames {
 public:
  void add(const std::string& name, std::span<const std::int64_t> pairs);
  [[nodiscard]] Names take();

 private:
  std::array<NamedIds, 4> by_dimension_{NamedIds(kVertexStem), NamedIds(kSegmentStem), NamedIds(kFacetStem),
                                        NamedIds(kRegionStem)};
};

/// Whether Holdfast reads an array of this name, or writes it only for viewers and solvers.
[[nodiscard]] inline bool is_known_array(std::string_view name) {
  return name == "region" || name == "marker" || name == "kind" || name == "mat_id" ||
         name == "input_vertex" || name == kVolumeVertex;
}

/// Arrays in which other programs store ids of cells, of tetrahedra and of others: read if there is no
/// "region" or "marker".
inline constexpr std::array<std::string_view, 7> kRegionArrays{
    "mat_id", "gmsh:physical", "medit:ref", "cell_tags", "CellEntityIds", "material", "attribute"};
inline constexpr std::array<std::string_view, 8> kMarkerArrays{
    "gmsh:physical", "medit:ref",        "facet_tags", "CellEntityIds",
    "BoundaryId",    "STLSolidLabeling", "PatchID",    "attribute"};

/// Cells as read from a file, not yet checked.
struct VtkGrid {
  std::vector<Point> points;
  std::vector<std::uint8_t> types;         ///< VtkCell, one per cell
  std::vector<std::int64_t> ends;          ///< end of each cell's corners
  std::vector<std::int64_t> connectivity;  ///< the corners of all cells
  std::vector<int> regions, markers;       ///< empty, or one per cell
  std::vector<int> point_markers;          ///< empty, or one per point
  std::vector<std::string> other_arrays;   ///< names of arrays that a mesh cannot store
  Names names = {};
};

/// Appends the cells of a part that names the same points.
void append_cells(VtkGrid& grid, const VtkGrid& part);

/// The mesh of a grid. Convex polygons are fanned. Throws FileError with the cell's number for unsupported
/// types and for corners that do not exist.
[[nodiscard]] MeshData mesh_of(const Source& source, VtkGrid&& grid);

}  // namespace holdfast::io
