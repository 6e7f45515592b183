// Writes XDMF 3 with its arrays in HDF5 (xdmf.org, "XDMF model and format"), as DOLFINx and meshio read it:
// NAME.xdmf has a grid "mesh" of tetrahedra with arrays in NAME.h5, and NAME_surface.xdmf one of triangles on
// the same points with arrays in NAME_surface.h5, because DOLFINx looks for arrays only in the file of the
// same name. In one file, the second grid is "surface"; without tetrahedra, the grid of triangles is "mesh".
#include "io/formats.h"
#include "io/hdf5_write.h"
#include "io/mesh_sets.h"
#include "io/vtk_cells.h"
#include "io/xdmf_grid.h"
#include "io/xml_reader.h"

namespace holdfast::io {
namespace {

struct Topology {
  std::vector<std::int64_t> nodes;
  std::uint64_t cells = 0, nodes_each = 0;
  std::vector<std::int32_t> ids;
};

template <typename NodesOf>
Topology topology_of(std::size_t cells, const std::vector<int>& ids, Watch& watch, NodesOf&& nodes_of) {
  Topology result;
  result.cells = cells;
  for (std::size_t i = 0; i < cells; ++i) {
    watch.beat();
    const Nodes nodes = nodes_of(i);
    result.nodes_each = nodes.count;
    result.nodes.insert(result.nodes.end(), nodes.begin(), nodes.end());
    result.ids.push_back(tag_of(ids, i));
  }
  return result;
}

void write_item(AtomicWriter& out, const std::string& file, std::string_view array, std::uint64_t rows,
                std::uint64_t columns, std::string_view type, int precision) {
  out << "<DataItem Dimensions=\"" << rows;
  if (columns != 1) out << ' ' << columns;
  out << "\" NumberType=\"" << type << "\" Precision=\"" << precision << "\" Format=\"HDF\">" << file << ":/"
      << array << "</DataItem>\n";
}

/// Writes names in meshio's form.
void write_names(AtomicWriter& out, const Names& names, bool surface_is_beside) {
  VtkFields fields = vtk_fields(names);
  if (surface_is_beside) fields[kSurfaceBeside] = {{1, -1}};  // names nothing, because it has no dimension
  if (fields.empty()) return;
  out << "<Information Name=\"Information\" Value=\"" << std::uint64_t{fields.size()} << "\"><![CDATA[<main>";
  for (const auto& [name, pairs] : fields)
    for (const auto& [id, dimension] : pairs)
      out << "<map key=\"" << escaped(name) << "\" dim=\"" << dimension << "\">" << id << "</map>";
  out << "</main>]]></Information>\n";
}

}  // namespace

void put_xdmf_grid(AtomicWriter& out, const XdmfHeavy& heavy, std::string_view name, const XdmfCells& cells,
                   const Names& names, bool surface_is_beside) {
  out << "<Grid Name=\"" << name << "\" GridType=\"Uniform\">\n<Topology TopologyType=\"" << cells.shape
      << "\" NumberOfElements=\"" << cells.cells << "\" NodesPerElement=\"" << cells.nodes_each << "\">\n";
  write_item(out, heavy.file, cells.array, cells.cells, cells.nodes_each, "Int", 8);
  out << "</Topology>\n<Geometry GeometryType=\"XYZ\">\n";
  write_item(out, heavy.file_of_points, "points", heavy.points, 3, "Float", 8);
  out << "</Geometry>\n";
  for (const std::string_view attribute : cells.attributes) {
    out << "<Attribute Name=\"" << attribute << "\" AttributeType=\"Scalar\" Center=\"Cell\">\n";
    write_item(out, heavy.file, attribute, cells.cells, 1, "Int", 4);
    out << "</Attribute>\n";
  }
  write_names(out, names, surface_is_beside);
  out << "</Grid>\n";
}

void begin_xdmf(AtomicWriter& out) {
  out << "<?xml version=\"1.0\"?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n"
         "<Xdmf Version=\"3.0\" xmlns:xi=\"http://www.w3.org/2001/XInclude\">\n<Domain>\n";
}
void end_xdmf(AtomicWriter& out) { out << "</Domain>\n</Xdmf>\n"; }

void write_xdmf_grid(AtomicWriter& out, const XdmfHeavy& heavy, const XdmfCells& cells, const Names& names,
                     bool surface_is_beside) {
  begin_xdmf(out);
  put_xdmf_grid(out, heavy, "mesh", cells, names, surface_is_beside);
  end_xdmf(out);
}

void write_xdmf(const std::filesystem::path& path, const Volume& volume, const WriteOptions& options,
                Watch& watch) {
  const bool second = is_second_order(volume);
  const Topology tetrahedra =
      topology_of(volume.tetrahedra.size(), volume.regions, watch,
                  [&](std::size_t i) { return tetrahedron_nodes(volume, i, kVtkEdges); });
  const Topology facets = topology_of(volume.facets.size(), volume.facet_markers, watch,
                                      [&](std::size_t i) { return facet_nodes(volume, i); });
  std::vector<Point> points = volume.vertices;
  points.insert(points.end(), volume.mid_nodes.points.begin(), volume.mid_nodes.points.end());
  const std::filesystem::path heavy_path = with_ending(path, ".h5"),
                              surface_heavy_path = surface_beside(heavy_path);
  const std::string heavy_name = escaped(heavy_path.filename().string()),
                    surface_heavy_name = escaped(surface_heavy_path.filename().string());
  const bool is_surface = tetrahedra.cells == 0 && facets.cells > 0;
  const bool alone = options.one_file || facets.cells == 0 || is_surface;
  const std::vector<Hdf5Array> of_facets{
      {"triangles", Hdf5Type::int64, facets.cells, facets.nodes_each, facets.nodes.data()},
      {"marker", Hdf5Type::int32, facets.cells, 1, facets.ids.data()}};
  const auto write_surface = [&](AtomicWriter& out, const std::string& file, std::string_view grid) {
    put_xdmf_grid(
        out, {file, heavy_name, points.size()}, grid,
        {second ? "Triangle_6" : "Triangle", "triangles", facets.cells, facets.nodes_each, {"marker"}},
        volume.names);
  };

  AtomicWriter heavy_file(heavy_path, &watch);
  std::vector<Hdf5Array> arrays{
      {"points", Hdf5Type::float64, points.size(), 3, points.data()},
      {"tetrahedra", Hdf5Type::int64, tetrahedra.cells, tetrahedra.nodes_each, tetrahedra.nodes.data()},
      {"region", Hdf5Type::int32, tetrahedra.cells, 1, tetrahedra.ids.data()}};
  if (alone && facets.cells > 0) arrays.insert(arrays.end(), of_facets.begin(), of_facets.end());
  write_hdf5(heavy_file, {"", {}, arrays, {}});

  AtomicWriter volume_file(path, &watch);
  begin_xdmf(volume_file);
  if (!is_surface)
    put_xdmf_grid(volume_file, {heavy_name, heavy_name, points.size()}, "mesh",
                  {second ? "Tetrahedron_10" : "Tetrahedron",
                   "tetrahedra",
                   tetrahedra.cells,
                   tetrahedra.nodes_each,
                   {"region"}},
                  volume.names, !alone);
  if (alone && facets.cells > 0) write_surface(volume_file, heavy_name, is_surface ? "mesh" : "surface");
  end_xdmf(volume_file);
  std::optional<AtomicWriter> surface_file, surface_heavy_file;
  if (!alone) {
    surface_heavy_file.emplace(surface_heavy_path, &watch);
    write_hdf5(*surface_heavy_file, {"", {}, of_facets, {}});
    surface_file.emplace(surface_beside(path), &watch);
    begin_xdmf(*surface_file);
    write_surface(*surface_file, surface_heavy_name, "mesh");
    end_xdmf(*surface_file);
    surface_heavy_file->finish();
    surface_file->finish();
  }
  // All files are completed before any gets its name.
  heavy_file.finish();
  volume_file.finish();
  heavy_file.commit();
  if (!alone) {
    surface_heavy_file->commit();
    surface_file->commit();
  }
  volume_file.commit();
}

std::vector<Remark> not_in_xdmf(const Volume& volume, const WriteOptions&) {
  std::vector<Remark> remarks;
  if (!volume.segments.empty())
    remarks.push_back({RemarkKind::not_held, volume.segments.size(),
                       std::to_string(volume.segments.size()) + " segments have no place in .xdmf"});
  tell_marked_vertices(volume, ".xdmf", remarks);
  return remarks;
}

}  // namespace holdfast::io
