// Reads XDMF 2 and 3 (xdmf.org, "XDMF model and format"): grids with their arrays in HDF5, in raw files or in
// the text, as Holdfast, DOLFINx, meshio and ParaView write them. Only the first grid of a time series is
// read.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <system_error>

#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/labels.h"
#include "io/text_reader.h"
#include "io/turn.h"
#include "io/xdmf_file.h"

namespace holdfast::io {
namespace {

struct XdmfShape {
  std::string_view name, short_name;
  std::int64_t number;  ///< in mixed topologies
  VtkCell cell;
  std::size_t corners;  ///< 0: given by NodesPerElement or the cell
};

constexpr XdmfShape kXdmfShapes[] = {
    {"polyvertex", "", 1, VtkCell::poly_vertex, 0},
    {"polyline", "", 2, VtkCell::poly_line, 0},
    {"polygon", "", 3, VtkCell::polygon, 0},
    {"triangle", "", 4, VtkCell::triangle, 3},
    {"quadrilateral", "", 5, VtkCell::quad, 4},
    {"tetrahedron", "", 6, VtkCell::tetrahedron, 4},
    {"edge_3", "", 34, VtkCell::quadratic_edge, 3},
    {"triangle_6", "tri_6", 36, VtkCell::quadratic_triangle, 6},
    {"tetrahedron_10", "tet_10", 38, VtkCell::quadratic_tetrahedron, 10},
    {"pyramid", "", 7, VtkCell::pyramid, 5},
    {"wedge", "", 8, VtkCell::wedge, 6},
    {"hexahedron", "", 9, VtkCell::hexahedron, 8},
    {"pyramid_13", "", 39, VtkCell::quadratic_pyramid, 13},
    {"wedge_15", "", 40, VtkCell::quadratic_wedge, 15},
    {"wedge_18", "", 41, VtkCell::biquadratic_wedge, 18},
    {"hexahedron_20", "hex_20", 48, VtkCell::quadratic_hexahedron, 20},
    {"hexahedron_24", "hex_24", 49, VtkCell::biquadratic_quadratic_hexahedron, 24},
    {"hexahedron_27", "hex_27", 50, VtkCell::triquadratic_hexahedron, 27},
};

bool is_volume(std::uint8_t type) {
  using enum VtkCell;
  switch (static_cast<VtkCell>(type)) {
    case tetrahedron:
    case quadratic_tetrahedron:
    case pyramid:
    case wedge:
    case hexahedron:
    case quadratic_pyramid:
    case quadratic_wedge:
    case biquadratic_wedge:
    case quadratic_hexahedron:
    case biquadratic_quadratic_hexahedron:
    case triquadratic_hexahedron:
      return true;
    default:
      return false;
  }
}

class XdmfReader {
 public:
  explicit XdmfReader(const Source& source) : file_(source) {}

  MeshData read() {
    if (file_.grids().empty())
      throw FileError(file_.source().path, "", "the file has no grid of points and cells");
    read_points();
    for (const XdmfGrid& grid : file_.grids()) read_cells(grid);
    grid_.names = file_.take_names();
    if (file_.surface_is_beside()) read_surface_beside();
    settle_tags();
    return mesh_of(file_.source(), std::move(grid_));
  }

 private:
  // All grids must have the points of the first, as those of cells, facets and edges of one mesh do.
  void read_points() {
    const auto with = std::find_if(file_.grids().begin(), file_.grids().end(),
                                   [](const XdmfGrid& g) { return g.geometry.has_value(); });
    if (with == file_.grids().end()) throw FileError(file_.source().path, "", "no grid has a Geometry");
    const std::string kind = lower(with->geometry->attribute("GeometryType"));
    const std::size_t dimension = kind == "xy" ? 2 : 3;
    if (!kind.empty() && kind != "xyz" && kind != "xy")
      file_.fail(*with->geometry, "points of the kind " + in_quotes(kind) + " are not read; XYZ are");
    const std::vector<double> values = file_.values_of<double>(with->points, *with->geometry);
    if (values.size() % dimension != 0) file_.fail(*with->geometry, "the last point is not whole");
    if (values.size() / dimension >= no_entity) file_.fail(*with->geometry, "more points than 32 bits count");
    const auto bad = std::find_if(values.begin(), values.end(), [](double x) { return !std::isfinite(x); });
    if (bad != values.end())
      file_.fail(*with->geometry,
                 "point " + std::to_string(static_cast<std::size_t>(bad - values.begin()) / dimension) +
                     " has a coordinate that is not finite");
    for (std::size_t i = 0; i < values.size(); i += dimension)
      grid_.points.push_back({values[i], values[i + 1], dimension == 3 ? values[i + 2] : 0});
    for (const XdmfGrid& grid : file_.grids()) {
      if (&grid == &*with || !grid.geometry) continue;
      if (file_.values_of<double>(grid.points, *grid.geometry) != values)
        file_.fail(*grid.geometry,
                   "the grids of the file have different points, and are not read as one mesh");
    }
  }

  const XdmfShape* shape_named(const std::string& name) const {
    const auto found =
        std::find_if(std::begin(kXdmfShapes), std::end(kXdmfShapes), [&](const XdmfShape& shape) {
          return name == shape.name || (!shape.short_name.empty() && name == shape.short_name);
        });
    return found == std::end(kXdmfShapes) ? nullptr : found;
  }

  void add_cell(VtkCell type, const std::int64_t* corners, std::size_t count) {
    grid_.types.push_back(static_cast<std::uint8_t>(type));
    grid_.connectivity.insert(grid_.connectivity.end(), corners, corners + count);
    grid_.ends.push_back(static_cast<std::int64_t>(grid_.connectivity.size()));
  }

  void read_cells(const XdmfGrid& grid) {
    const std::size_t first = grid_.types.size();
    if (!grid.topology) {  // attributes of the first grid's cells
      if (&grid == &file_.grids().front()) file_.fail(grid.tag, "the grid has no Topology");
      std::vector<std::size_t> cells(first_cells_);
      std::iota(cells.begin(), cells.end(), std::size_t{0});
      return read_attributes(grid, cells);
    }
    const XmlTag& tag = *grid.topology;
    std::string name = lower(tag.attribute("TopologyType"));
    if (name.empty()) name = lower(tag.attribute("Type"));
    const std::vector<std::int64_t> nodes = file_.values_of<std::int64_t>(grid.cells, tag);
    if (name == "mixed") {
      read_mixed(tag, nodes);
    } else {
      const XdmfShape* const shape = shape_named(name);
      if (shape == nullptr)
        file_.fail(tag, "cells of the type " + in_quotes(name) +
                            " are not read; split them into triangles or tetrahedra");
      std::size_t corners = shape->corners;
      if (corners == 0) {
        corners = tag.attribute("NodesPerElement").empty()
                      ? 1 + (shape->cell == VtkCell::poly_line)
                      : static_cast<std::size_t>(file_.number(tag, "NodesPerElement"));
        if (corners == 0) file_.fail(tag, "cells without corners");
      }
      if (nodes.size() % corners != 0) file_.fail(tag, "the last cell is not whole");
      for (std::size_t i = 0; i < nodes.size(); i += corners) add_cell(shape->cell, &nodes[i], corners);
    }
    const std::size_t count = grid_.types.size() - first;
    const std::string announced = tag.attribute("NumberOfElements");
    if (!announced.empty() && announced.find_first_not_of("0123456789") == std::string::npos &&
        file_.number(tag, "NumberOfElements") != count)
      file_.fail(tag, "the number of cells is " + std::to_string(count) + ", but NumberOfElements says " +
                          announced);
    if (&grid == &file_.grids().front()) first_cells_ = count;
    std::vector<std::size_t> cells = take_off_known(first);
    if (cells.empty()) {
      cells.resize(count);
      std::iota(cells.begin(), cells.end(), first);
    }
    read_attributes(grid, cells);
  }

  void read_mixed(const XmlTag& tag, const std::vector<std::int64_t>& nodes) {
    for (std::size_t i = 0; i < nodes.size();) {
      beat(file_.source().watch);
      const auto shape = std::find_if(std::begin(kXdmfShapes), std::end(kXdmfShapes),
                                      [&](const XdmfShape& s) { return s.number == nodes[i]; });
      if (shape == std::end(kXdmfShapes))
        file_.fail(tag, "cells of the type " + std::to_string(nodes[i]) +
                            " are not read; split them into triangles or tetrahedra");
      std::size_t corners = shape->corners;
      ++i;
      if (corners == 0) {
        if (i == nodes.size() || nodes[i] < 1 || static_cast<std::uint64_t>(nodes[i]) > nodes.size())
          file_.fail(tag, "a cell has no number of corners");
        corners = static_cast<std::size_t>(nodes[i++]);
      }
      if (corners > nodes.size() - i) file_.fail(tag, "the last cell is not whole");
      add_cell(shape->cell, &nodes[i], corners);
      i += corners;
    }
  }

  // The ids of cells: of volumes the regions, of other cells the markers.
  void read_attributes(const XdmfGrid& grid, const std::vector<std::size_t>& cells) {
    const auto is_ids = [&](const XdmfAttribute& a) {
      const std::string center = lower(a.tag.attribute("Center"));
      return !a.items.empty() && (center == "cell" || center.empty()) &&
             file_.holds_integers(a.items.front());
    };
    const XdmfAttribute* ids = nullptr;
    const auto rank_of = [&](const XdmfAttribute& a) {
      const std::string name = a.tag.attribute("Name");
      if (name == "region" || name == "marker") return 0;
      const auto is_in = [&](const auto& known) {
        return std::find(known.begin(), known.end(), name) != known.end();
      };
      if (is_in(kRegionArrays) || is_in(kMarkerArrays)) return 1;
      return 2;
    };
    for (const XdmfAttribute& a : grid.attributes)
      if (is_ids(a) && (ids == nullptr || rank_of(a) < rank_of(*ids))) ids = &a;
    for (const XdmfAttribute& a : grid.attributes)
      if (&a != ids && rank_of(a) > 0) grid_.other_arrays.push_back(a.tag.attribute("Name"));
    if (ids == nullptr) return;
    const std::vector<std::int64_t> values = file_.values_of<std::int64_t>(ids->items, ids->tag);
    if (values.size() != cells.size())
      file_.fail(ids->tag, "there are " + std::to_string(values.size()) + " values for " +
                               std::to_string(cells.size()) + " cells");
    tags_.resize(grid_.types.size(), 0);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!std::in_range<int>(values[i]))
        file_.fail(ids->tag, "value " + std::to_string(i) + " is no id of 32 bits");
      tags_[cells[i]] = static_cast<int>(values[i]);
    }
  }

  /// A grid that repeats the tetrahedra of an earlier one lists their tags, in any order. Then removes them
  /// again and returns which cells they are.
  std::vector<std::size_t> take_off_known(std::size_t first) {
    std::vector<std::size_t> known;
    const auto key_of = [&](std::size_t cell) {
      const std::int64_t begin = cell == 0 ? 0 : grid_.ends[cell - 1];
      std::array<std::int64_t, 4> key{};
      std::copy_n(grid_.connectivity.begin() + begin, 4, key.begin());
      std::sort(key.begin(), key.end());
      return key;
    };
    if (first == 0 || first == grid_.types.size()) return known;
    std::map<std::array<std::int64_t, 4>, std::size_t> cells;
    for (std::size_t i = 0; i < first; ++i)
      if (is_volume(grid_.types[i])) cells.emplace(key_of(i), i);
    for (std::size_t i = first; i < grid_.types.size(); ++i) {
      beat(file_.source().watch);
      const auto found = is_volume(grid_.types[i]) ? cells.find(key_of(i)) : cells.end();
      if (found == cells.end()) return {};
      known.push_back(found->second);
    }
    grid_.types.resize(first);
    grid_.ends.resize(first);
    grid_.connectivity.resize(static_cast<std::size_t>(grid_.ends.back()));
    return known;
  }

  void settle_tags() {
    tags_.resize(grid_.types.size(), 0);
    grid_.regions.resize(tags_.size(), 0);
    grid_.markers.resize(tags_.size(), 0);
    for (std::size_t i = 0; i < tags_.size(); ++i)
      (is_volume(grid_.types[i]) ? grid_.regions : grid_.markers)[i] = tags_[i];
    if (file_.left_out() > 0) grid_.other_arrays.push_back("grids of later times");
  }

  /// Reads NAME_surface.xdmf, which has the same points.
  void read_surface_beside() {
    const std::filesystem::path beside = surface_beside(without_gz(file_.source().path));
    std::error_code error;
    if (!std::filesystem::exists(beside, error)) {
      grid_.other_arrays.push_back("facets in " + beside.filename().string() + ", which is not there");
      return;
    }
    const FileBytes bytes(beside, file_.source().watch);
    XdmfReader reader({beside, bytes.view(), file_.source().finite, file_.source().watch});
    reader.read_points();
    if (reader.grid_.points != grid_.points)
      throw FileError(beside, "", "its points are not the volume's; the two files are not of one run");
    for (const XdmfGrid& grid : reader.file_.grids()) reader.read_cells(grid);
    tags_.resize(grid_.types.size(), 0);
    reader.tags_.resize(reader.grid_.types.size(), 0);
    append_cells(grid_, reader.grid_);
    tags_.insert(tags_.end(), reader.tags_.begin(), reader.tags_.end());
  }

  XdmfFile file_;
  VtkGrid grid_;
  std::vector<int> tags_;        ///< one per cell
  std::size_t first_cells_ = 0;  ///< of the first grid
};

}  // namespace

MeshData read_xdmf(const Source& source) {
  MeshData mesh = XdmfReader(source).read();
  turn_to_vtk(mesh);
  return mesh;
}

}  // namespace holdfast::io
