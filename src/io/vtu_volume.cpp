// Volumes as VTK's XML files: tetrahedra in one file and their boundary in another beside it, because viewers
// and solvers do not handle two-dimensional cells in the same grid well; or both in one file; and a .vtm that
// lists the two as blocks.
#include <algorithm>
#include <bit>
#include <system_error>

#include "io/formats.h"
#include "io/mesh_sets.h"
#include "io/vtk_cells.h"
#include "io/vtu_arrays.h"
#include "io/xml_reader.h"

namespace holdfast::io {
namespace {

struct Cells {
  VtuCells cells;
  std::vector<std::int32_t> regions, markers, kinds;
  void add(VtkCell type, const Nodes& nodes, int kind, int region, int marker) {
    cells.add(type, std::span(nodes.of.data(), nodes.count));
    kinds.push_back(kind);
    regions.push_back(region);
    markers.push_back(marker);
  }
};

void add_tetrahedra(Cells& to, const Volume& volume, Watch* watch) {
  const VtkCell type = is_second_order(volume) ? VtkCell::quadratic_tetrahedron : VtkCell::tetrahedron;
  for (std::size_t i = 0; i < volume.tetrahedra.size(); ++i) {
    beat(watch);
    to.add(type, tetrahedron_nodes(volume, i, kVtkEdges), 3, tag_of(volume.regions, i), 0);
  }
}

void add_surface(Cells& to, const Volume& volume, Watch* watch) {
  const bool second = is_second_order(volume);
  for (std::size_t i = 0; i < volume.facets.size(); ++i) {
    beat(watch);
    to.add(second ? VtkCell::quadratic_triangle : VtkCell::triangle, facet_nodes(volume, i), 2, 0,
           tag_of(volume.facet_markers, i));
  }
  for (std::size_t i = 0; i < volume.segments.size(); ++i) {
    beat(watch);
    to.add(second ? VtkCell::quadratic_edge : VtkCell::line, segment_nodes(volume, i), 1, 0,
           tag_of(volume.segment_markers, i));
  }
}

std::vector<Point> nodes_of(const Volume& volume) {
  std::vector<Point> points = volume.vertices;
  points.insert(points.end(), volume.mid_nodes.points.begin(), volume.mid_nodes.points.end());
  return points;
}

/// Writes the tetrahedra and, with `all`, their boundary, with all vertices.
void write_grid(AtomicWriter& out, const Volume& volume, const WriteOptions& options, bool all) {
  Cells cells;
  add_tetrahedra(cells, volume, out.watch());
  if (all) add_surface(cells, volume, out.watch());
  const std::vector<Point> points = nodes_of(volume);
  // The region comes first: viewers colour by the first array, and meshio keeps it if it keeps only one.
  std::vector<VtuArray> cell_data{vtu_array("region", cells.regions)};
  if (all) {
    cell_data.push_back(vtu_array("marker", cells.markers));
    cell_data.push_back(vtu_array("kind", cells.kinds));
  }
  cell_data.push_back(vtu_array("mat_id", cells.regions));  // sfepy's name for it
  VtuArrays arrays = cells.cells.arrays(points, std::move(cell_data));
  std::vector<std::int64_t> input = volume.input_vertices;
  std::vector<std::int32_t> markers(volume.vertex_markers.begin(), volume.vertex_markers.end());
  if (!input.empty()) {
    input.resize(points.size(), -1);
    arrays.point_data.push_back(vtu_array("input_vertex", input));
  }
  if (!markers.empty()) {
    markers.resize(points.size(), 0);
    arrays.point_data.push_back(vtu_array("marker", markers));
  }
  arrays.field_data = vtk_fields(volume.names);
  if (!all) arrays.field_data[kSurfaceBeside] = {{1, -1}};  // names nothing, because it has no dimension
  write_vtu_arrays(out, arrays, options);
}

/// Writes facets and segments with their own points, which have their indices in the volume.
void write_surface_grid(AtomicWriter& out, const Volume& volume, const WriteOptions& options) {
  Cells cells;
  std::vector<Point> points;
  std::vector<std::int64_t> in_volume;
  std::vector<Index> number(node_count(volume), no_entity);
  const auto use = [&](const Nodes& nodes) {
    for (const Index v : nodes)
      if (number[v] == no_entity) number[v] = 0;
  };
  for (std::size_t i = 0; i < volume.facets.size(); ++i) use(facet_nodes(volume, i));
  for (std::size_t i = 0; i < volume.segments.size(); ++i) use(segment_nodes(volume, i));
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == no_entity) continue;
    number[v] = static_cast<Index>(points.size());
    points.push_back(node(volume, v));
    in_volume.push_back(static_cast<std::int64_t>(v));
  }
  Volume surface;  // the same entities in these points
  const auto renumbered = [&](auto entities) {
    for (auto& entity : entities)
      for (Index& v : entity) v = number[v];
    return entities;
  };
  surface.facets = renumbered(volume.facets);
  surface.segments = renumbered(volume.segments);
  surface.facet_markers = volume.facet_markers;
  surface.segment_markers = volume.segment_markers;
  if (is_second_order(volume)) {
    surface.mid_nodes.points.resize(1);  // marks it as second order
    surface.mid_nodes.facets = renumbered(volume.mid_nodes.facets);
    for (const Index v : volume.mid_nodes.segments) surface.mid_nodes.segments.push_back(number[v]);
  }
  add_surface(cells, surface, out.watch());
  VtuArrays arrays =
      cells.cells.arrays(points, {vtu_array("marker", cells.markers), vtu_array("kind", cells.kinds)},
                         {vtu_array(kVolumeVertex, in_volume)});
  arrays.field_data = vtk_fields(volume.names);
  write_vtu_arrays(out, arrays, options);
}

void write_files(const std::filesystem::path& path, const Volume& volume, const WriteOptions& options,
                 Watch& watch, bool blocks) {
  const std::filesystem::path grid = blocks ? with_ending(path, ".vtu") : path;
  AtomicWriter volume_file(grid, &watch), surface_file(surface_beside(grid), &watch);
  write_grid(volume_file, volume, options, false);
  write_surface_grid(surface_file, volume, options);
  std::optional<AtomicWriter> index;
  if (blocks) {
    index.emplace(path, &watch);
    *index
        << "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" byte_order=\""
        << (std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian")
        << "\" header_type=\"UInt64\">\n<vtkMultiBlockDataSet>\n<DataSet index=\"0\" name=\"volume\" file=\""
        << escaped(grid.filename().string()) << "\"/>\n<DataSet index=\"1\" name=\"surface\" file=\""
        << escaped(surface_beside(grid).filename().string()) << "\"/>\n</vtkMultiBlockDataSet>\n</VTKFile>\n";
    index->finish();
  }
  // All files are completed before any gets its name.
  for (AtomicWriter* file : {&volume_file, &surface_file}) file->finish();
  for (AtomicWriter* file : {&surface_file, &volume_file}) file->commit();
  if (index) index->commit();
}

}  // namespace

std::filesystem::path with_ending(const std::filesystem::path& path, const char* ending) {
  std::filesystem::path result = path;
  return result.replace_extension(ending);
}

std::filesystem::path surface_beside(const std::filesystem::path& path) {
  std::filesystem::path name = path.stem();
  name += "_surface";
  name += path.extension();
  return path.parent_path() / name;
}

bool can_have_a_file_beside(const std::filesystem::path& path) {
  if (descriptor_of(path)) return false;
  std::error_code error;
  const bool exists = std::filesystem::exists(path, error);
  if (error) return false;  // for example a name that is too long, which the writer reports
  return !exists || std::filesystem::is_regular_file(path, error);
}

void write_vtu(const std::filesystem::path& path, const Volume& volume, const WriteOptions& options,
               Watch& watch) {
  const bool bounded = !volume.facets.empty() || !volume.segments.empty();
  if (!options.one_file && bounded && !volume.tetrahedra.empty() && can_have_a_file_beside(path))
    return write_files(path, volume, options, watch, false);
  AtomicWriter out(path, &watch);
  write_grid(out, volume, options, true);
  out.commit();
}

void write_vtm(const std::filesystem::path& path, const Volume& volume, const WriteOptions& options,
               Watch& watch) {
  write_files(path, volume, options, watch, true);
}

}  // namespace holdfast::io
