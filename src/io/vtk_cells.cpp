// Converts the cells of VTK formats to facets, segments and tetrahedra.
#include "io/vtk_cells.h"

#include <span>
#include <utility>

#include "io/cells.h"
#include "io/mid_nodes.h"
#include "io/polygon.h"
#include "io/text_reader.h"
#include "text/count.h"

namespace holdfast::io {
namespace {

class CellReader {
 public:
  CellReader(const Source& source, VtkGrid&& grid)
      : path_(source.path), watch_(source.watch), grid_(std::move(grid)), mesh_(source) {
    mesh_.vertices = std::move(grid_.points);
    mesh_.names = std::move(grid_.names);
  }

  MeshData read() {
    const std::size_t cells = grid_.types.size();
    if (grid_.ends.size() != cells)
      throw FileError(path_, "", counted(grid_.ends.size(), "cell") + ", but " + counted(cells, "cell type"));
    for (const auto* tags : {&grid_.regions, &grid_.markers})
      if (!tags->empty() && tags->size() != cells)
        throw FileError(path_, "", "'region' or 'marker' has not one value a cell");
    if (!grid_.point_markers.empty() && grid_.point_markers.size() != mesh_.vertices.size())
      throw FileError(path_, "", "'marker' has not one value a point");
    tell_arrays();
    std::size_t begin = 0;
    for (cell_ = 0; cell_ < cells; ++cell_) {
      beat(watch_);
      const std::int64_t end = grid_.ends[cell_];
      if (end < static_cast<std::int64_t>(begin) ||
          static_cast<std::uint64_t>(end) > grid_.connectivity.size())
        fail("its corners end outside the list of corners");
      read_corners(begin, static_cast<std::size_t>(end));
      add_cell();
      begin = static_cast<std::size_t>(end);
    }
    for (std::size_t i = 0; i < grid_.point_markers.size(); ++i)
      mesh_.vertex_markers.add(i, grid_.point_markers[i]);
    return std::move(mesh_);
  }

 private:
  void tell_arrays() {
    std::string names;
    for (const std::string& name : grid_.other_arrays) names += (names.empty() ? "" : ", ") + in_quotes(name);
    mesh_.leave_out(grid_.other_arrays.size(), "arrays (" + names + ")", "array (" + names + ")");
  }

  /// A vertex cell sets the vertex marker, unless an array of the points does.
  void mark_vertices(int marker) {
    if (marker == 0) return;
    grid_.point_markers.resize(mesh_.vertices.size(), 0);
    for (const Index vertex : corners_)
      if (grid_.point_markers[vertex] == 0) grid_.point_markers[vertex] = marker;
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw FileError(path_, "cell " + std::to_string(cell_), reason);
  }

  void read_corners(std::size_t begin, std::size_t end) {
    corners_.clear();
    for (std::size_t i = begin; i < end; ++i) {
      const std::int64_t corner = grid_.connectivity[i];
      if (corner < 0 || static_cast<std::uint64_t>(corner) >= mesh_.vertices.size())
        fail("names vertex " + std::to_string(corner) + ", but there are " +
             std::to_string(mesh_.vertices.size()));
      corners_.push_back(static_cast<Index>(corner));
    }
  }

  void require_corners(std::size_t count) const {
    if (corners_.size() != count)
      fail("has " + std::to_string(corners_.size()) + " corners instead of " + std::to_string(count));
  }

  /// Gmsh writes elements of third order with the types of first order.
  [[nodiscard]] bool is_of_third_order() const {
    switch (static_cast<VtkCell>(grid_.types[cell_])) {
      case VtkCell::line:
        return corners_.size() == 4;
      case VtkCell::triangle:
        return corners_.size() == 10;
      case VtkCell::quad:
        return corners_.size() == 16;
      case VtkCell::tetrahedron:
        return corners_.size() == 20;
      default:
        return false;
    }
  }

  void add_cell() {
    const int marker = tag_of(grid_.markers, cell_);
    if (is_of_third_order()) return add_by_corners(marker);
    switch (static_cast<VtkCell>(grid_.types[cell_])) {
      case VtkCell::vertex:
      case VtkCell::poly_vertex:
        return mark_vertices(marker);
      case VtkCell::line:
        require_corners(2);
        [[fallthrough]];
      case VtkCell::poly_line:
        for (std::size_t i = 0; i + 1 < corners_.size(); ++i)
          mesh_.add_segment({corners_[i], corners_[i + 1]}, marker);
        return;
      case VtkCell::triangle:
        require_corners(3);
        return mesh_.add_facet({corners_[0], corners_[1], corners_[2]}, marker);
      case VtkCell::triangle_strip:
        if (corners_.size() < 3) fail("is a strip of fewer than 3 corners");
        return add_strip(mesh_, corners_, marker);
      case VtkCell::pixel:
        require_corners(4);
        std::swap(corners_[2], corners_[3]);  // a pixel's corners are in rows, not counterclockwise
        return add_polygon(mesh_, corners_, marker, [&](const std::string& reason) { fail(reason); });
      case VtkCell::quad:
        require_corners(4);
        [[fallthrough]];
      case VtkCell::polygon:
        return add_face(mesh_, corners_, marker, [&](const std::string& reason) { fail(reason); });
      case VtkCell::tetrahedron:
        require_corners(4);
        return mesh_.add_tetrahedron({corners_[0], corners_[1], corners_[2], corners_[3]},
                                     tag_of(grid_.regions, cell_));
      case VtkCell::voxel:
        require_corners(8);
        std::swap(corners_[2], corners_[3]);  // in rows, not counterclockwise
        std::swap(corners_[6], corners_[7]);
        return add_cell_of(8);
      case VtkCell::quadratic_edge:
        require_corners(3);
        return add_second_order(mesh_, Segment{corners_[0], corners_[1]}, corners_[2], marker);
      case VtkCell::quadratic_triangle:
        require_corners(6);
        return add_second_order(mesh_, Triangle{corners_[0], corners_[1], corners_[2]},
                                {corners_[3], corners_[4], corners_[5]}, marker);
      case VtkCell::quadratic_tetrahedron:
        require_corners(10);
        return add_second_order(
            mesh_, Tetrahedron{corners_[0], corners_[1], corners_[2], corners_[3]},
            {corners_[4], corners_[5], corners_[6], corners_[7], corners_[8], corners_[9]},
            tag_of(grid_.regions, cell_));
      default:
        return add_by_corners(marker);
    }
  }

  /// Reads cells of arbitrary order, and unsupported ones of second order, by their corners, which come
  /// first.
  void add_by_corners(int marker) {
    const auto corners = [&](std::size_t count) {
      if (corners_.size() < count) fail("has fewer than " + counted(count, "corner"));
      add_no_corners(mesh_, std::span(corners_).subspan(count));
      return std::span<const Index>(corners_).first(count);
    };
    switch (static_cast<VtkCell>(grid_.types[cell_])) {
      case VtkCell::line:
      case VtkCell::lagrange_curve: {
        const auto c = corners(2);
        return mesh_.add_segment({c[0], c[1]}, marker);
      }
      case VtkCell::triangle:
      case VtkCell::biquadratic_triangle:
      case VtkCell::lagrange_triangle: {
        const auto c = corners(3);
        return mesh_.add_facet({c[0], c[1], c[2]}, marker);
      }
      case VtkCell::quad:
      case VtkCell::quadratic_quad:
      case VtkCell::biquadratic_quad:
      case VtkCell::lagrange_quad:
        return add_polygon(mesh_, corners(4), marker, [&](const std::string& reason) { fail(reason); });
      case VtkCell::tetrahedron:
      case VtkCell::lagrange_tetrahedron: {
        const auto c = corners(4);
        return mesh_.add_tetrahedron({c[0], c[1], c[2], c[3]}, tag_of(grid_.regions, cell_));
      }
      case VtkCell::hexahedron:
      case VtkCell::quadratic_hexahedron:
      case VtkCell::triquadratic_hexahedron:
      case VtkCell::biquadratic_quadratic_hexahedron:
      case VtkCell::lagrange_hexahedron:
        return add_cell_of(8);
      case VtkCell::wedge:
      case VtkCell::quadratic_wedge:
      case VtkCell::quadratic_linear_wedge:
      case VtkCell::biquadratic_wedge:
      case VtkCell::lagrange_wedge:
        return add_cell_of(6);
      case VtkCell::pyramid:
      case VtkCell::quadratic_pyramid:
      case VtkCell::triquadratic_pyramid:
      case VtkCell::lagrange_pyramid:
        return add_cell_of(5);
      default:
        fail("is of type " + std::to_string(grid_.types[cell_]) +
             ", which is not read; split it into triangles or tetrahedra");
    }
  }

  void add_cell_of(std::size_t corners) {
    if (corners_.size() < corners) fail("has fewer than " + counted(corners, "corner"));
    io::add_cell(mesh_, corners_, corners, tag_of(grid_.regions, cell_));
  }

  const std::filesystem::path& path_;
  Watch* const watch_;
  VtkGrid grid_;
  MeshData mesh_;
  std::size_t cell_ = 0;
  std::vector<Index> corners_;
};

}  // namespace

VtkFields vtk_fields(const Names& names) {
  VtkFields fields;
  const std::map<int, std::string>* const kinds[] = {&names.vertices, &names.segments, &names.facets,
                                                     &names.regions};
  for (int dimension = 3; dimension >= 0; --dimension)
    for (const auto& [id, name] : *kinds[dimension]) fields[name].push_back({id, dimension});
  return fields;
}

void VtkNames::add(const std::string& name, std::span<const std::int64_t> pairs) {
  if (pairs.size() % 2 != 0) return;
  for (std::size_t i = 0; i < pairs.size(); i += 2) {
    const std::int64_t id = pairs[i], dimension = pairs[i + 1];
    if (dimension < 0 || dimension > 3 || !std::in_range<int>(id)) return;
    by_dimension_[static_cast<std::size_t>(dimension)].set(static_cast<int>(id), name);
  }
}

Names VtkNames::take() {
  return {by_dimension_[2].take(), by_dimension_[3].take(), by_dimension_[1].take(), by_dimension_[0].take()};
}

void append_cells(VtkGrid& grid, const VtkGrid& part) {
  const auto base = static_cast<std::int64_t>(grid.connectivity.size());
  for (const std::int64_t end : part.ends) grid.ends.push_back(base + end);
  grid.types.insert(grid.types.end(), part.types.begin(), part.types.end());
  grid.connectivity.insert(grid.connectivity.end(), part.connectivity.begin(), part.connectivity.end());
}

MeshData mesh_of(const Source& source, VtkGrid&& grid) { return CellReader(source, std::move(grid)).read(); }

}  // namespace holdfast::io
