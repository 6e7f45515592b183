// Writes pieces as VTK's parallel XML format
// (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html, "PUnstructuredGrid"): one grid per
// piece, and a file that lists them. Ghosts have 1 in vtkGhostType, as VTK's
// vtkDataSetAttributes::DUPLICATECELL and DUPLICATEPOINT.
#include <bit>
#include <deque>
#include <system_error>

#include "io/formats.h"
#include "io/mesh_sets.h"
#include "io/pieces.h"
#include "io/vtk_cells.h"
#include "io/vtu_arrays.h"
#include "io/xml_reader.h"

namespace holdfast::io {
namespace {

constexpr std::uint8_t kDuplicate = 1;

struct ArrayName {
  const char *type, *name;
};
constexpr ArrayName kCellArrays[] = {
    {"Int32", "region"}, {"Int32", "part"}, {"Int64", "tetrahedron"}, {"UInt8", "vtkGhostType"}};
constexpr ArrayName kSurfaceCellArrays[] = {
    {"Int32", "marker"}, {"Int32", "kind"}, {"UInt8", "vtkGhostType"}};
constexpr ArrayName kPointArrays[] = {{"Int64", "vertex"}, {"UInt8", "vtkGhostType"}};
constexpr ArrayName kSurfacePointArrays[] = {
    {"Int64", kVolumeVertex}, {"Int64", "vertex"}, {"UInt8", "vtkGhostType"}};

std::vector<std::uint8_t> ghost_types(const std::vector<Index>& owners, std::size_t part) {
  std::vector<std::uint8_t> types;
  types.reserve(owners.size());
  for (const Index owner : owners) types.push_back(owner == part ? std::uint8_t{0} : kDuplicate);
  return types;
}

std::vector<std::int64_t> signed_numbers(const std::vector<std::uint64_t>& numbers) {
  return {numbers.begin(), numbers.end()};
}

/// Rows with the other part and the three vertices of a face.
VtuTable interface_table(const MeshPiece& piece) {
  VtuTable table{kInterfaces, 4, {}};
  for (const MeshPiece::Interface& interface : piece.interfaces)
    for (const Triangle& face : interface.faces)
      table.values.insert(table.values.end(), {std::int64_t{interface.other}, face[0], face[1], face[2]});
  return table;
}

void write_grid(AtomicWriter& out, const MeshPiece& piece, std::size_t part, const WriteOptions& options) {
  VtuCells cells;
  cells.reserve(piece.volume.tetrahedra.size(), 4 * piece.volume.tetrahedra.size());
  for (const Tetrahedron& t : piece.volume.tetrahedra) {
    beat(out.watch());
    cells.add(VtkCell::tetrahedron, t);
  }
  std::vector<std::int32_t> regions(piece.volume.regions.begin(), piece.volume.regions.end());
  regions.resize(piece.volume.tetrahedra.size(), 0);
  const std::vector<std::int32_t> parts(piece.owners.begin(), piece.owners.end());
  const std::vector<std::int64_t> tetrahedra = signed_numbers(piece.tetrahedra),
                                  vertices = signed_numbers(piece.vertices);
  const std::vector<std::uint8_t> ghost_cells = ghost_types(piece.owners, part),
                                  ghost_points = ghost_types(piece.vertex_owners, part);
  VtuArrays arrays = cells.arrays(
      piece.volume.vertices,
      {vtu_array(kCellArrays[0].name, regions), vtu_array(kCellArrays[1].name, parts),
       vtu_array(kCellArrays[2].name, tetrahedra), vtu_array(kCellArrays[3].name, ghost_cells)},
      {vtu_array(kPointArrays[0].name, vertices), vtu_array(kPointArrays[1].name, ghost_points)});
  const std::vector<std::int32_t> markers(piece.volume.vertex_markers.begin(),
                                          piece.volume.vertex_markers.end());
  if (!markers.empty()) arrays.point_data.push_back(vtu_array("marker", markers));
  if (!piece.volume.input_vertices.empty())
    arrays.point_data.push_back(vtu_array("input_vertex", piece.volume.input_vertices));
  arrays.field_data = vtk_fields(piece.volume.names);
  arrays.field_data[kSurfaceBeside] = {{1, -1}};  // names nothing, because it has no dimension
  arrays.tables = {interface_table(piece)};
  write_vtu_arrays(out, arrays, options);
}

/// Writes facets and segments with their own points.
void write_surface_grid(AtomicWriter& out, const MeshPiece& piece, std::size_t part,
                        const WriteOptions& options) {
  const Volume& volume = piece.volume;
  std::vector<Index> number(volume.vertices.size(), no_entity);
  for (const Triangle& t : volume.facets)
    for (const Index v : t) number[v] = 0;
  for (const Segment& s : volume.segments)
    for (const Index v : s) number[v] = 0;
  std::vector<Point> points;
  std::vector<std::int64_t> in_volume, in_whole;
  std::vector<Index> point_owners, cell_owners = piece.facet_owners;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == no_entity) continue;
    number[v] = static_cast<Index>(points.size());
    points.push_back(volume.vertices[v]);
    in_volume.push_back(static_cast<std::int64_t>(v));
    in_whole.push_back(static_cast<std::int64_t>(piece.vertices[v]));
    point_owners.push_back(piece.vertex_owners[v]);
  }
  VtuCells cells;
  std::vector<std::int32_t> markers, kinds;
  for (std::size_t i = 0; i < volume.facets.size(); ++i) {
    const Triangle& t = volume.facets[i];
    cells.add(VtkCell::triangle, Triangle{number[t[0]], number[t[1]], number[t[2]]});
    markers.push_back(tag_of(volume.facet_markers, i));
    kinds.push_back(2);
  }
  for (std::size_t i = 0; i < volume.segments.size(); ++i) {
    const Segment& s = volume.segments[i];
    cells.add(VtkCell::line, Segment{number[s[0]], number[s[1]]});
    markers.push_back(tag_of(volume.segment_markers, i));
    kinds.push_back(1);
  }
  cell_owners.insert(cell_owners.end(), piece.segment_owners.begin(), piece.segment_owners.end());
  const std::vector<std::uint8_t> ghost_cells = ghost_types(cell_owners, part),
                                  ghost_points = ghost_types(point_owners, part);
  VtuArrays arrays = cells.arrays(
      points,
      {vtu_array(kSurfaceCellArrays[0].name, markers), vtu_array(kSurfaceCellArrays[1].name, kinds),
       vtu_array(kSurfaceCellArrays[2].name, ghost_cells)},
      {vtu_array(kSurfacePointArrays[0].name, in_volume), vtu_array(kSurfacePointArrays[1].name, in_whole),
       vtu_array(kSurfacePointArrays[2].name, ghost_points)});
  arrays.field_data = vtk_fields(volume.names);
  write_vtu_arrays(out, arrays, options);
}

void declare(AtomicWriter& out, std::span<const ArrayName> arrays) {
  for (const ArrayName& array : arrays)
    out << "<PDataArray type=\"" << array.type << "\" Name=\"" << array.name << "\"/>\n";
}

template <typename PieceName>
void write_index(AtomicWriter& out, std::size_t parts, bool compress, std::span<const ArrayName> cells,
                 std::span<const ArrayName> points, PieceName&& piece_name) {
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\""
      << (std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian")
      << "\" header_type=\"UInt64\"" << (compress ? " compressor=\"vtkZLibDataCompressor\"" : "")
      << ">\n<PUnstructuredGrid GhostLevel=\"1\">\n<PPoints>\n<PDataArray type=\"Float64\" Name=\"Points\" "
         "NumberOfComponents=\"3\"/>\n</PPoints>\n<PCellData>\n";
  declare(out, cells);
  out << "</PCellData>\n<PPointData>\n";
  declare(out, points);
  out << "</PPointData>\n";
  for (std::size_t k = 0; k < parts; ++k)
    out << "<Piece Source=\"" << escaped(piece_name(k).filename().string()) << "\"/>\n";
  out << "</PUnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace

std::filesystem::path pvtu_piece(const std::filesystem::path& path, std::size_t k) {
  std::filesystem::path name = path.stem();
  name += "_" + std::to_string(k) + ".vtu";
  return path.parent_path() / name;
}

void write_pvtu(const std::filesystem::path& path, std::size_t parts, const PieceLoader& load,
                const WriteOptions& options, Watch& watch) {
  const std::filesystem::path surface = surface_beside(path);
  std::deque<AtomicWriter> files;
  for (std::size_t k = 0; k < parts; ++k) {
    const MeshPiece piece = load(k);
    const std::filesystem::path name = pvtu_piece(path, k);
    AtomicWriter& bounds = files.emplace_back(surface_beside(name), &watch);
    write_surface_grid(bounds, piece, k, options);
    bounds.finish();
    AtomicWriter& grid = files.emplace_back(name, &watch);
    write_grid(grid, piece, k, options);
    grid.finish();
  }
  AtomicWriter& surface_index = files.emplace_back(surface, &watch);
  write_index(surface_index, parts, options.compress, kSurfaceCellArrays, kSurfacePointArrays,
              [&](std::size_t k) { return surface_beside(pvtu_piece(path, k)); });
  surface_index.finish();
  AtomicWriter& index = files.emplace_back(path, &watch);
  write_index(index, parts, options.compress, kCellArrays, kPointArrays,
              [&](std::size_t k) { return pvtu_piece(path, k); });
  index.finish();
  // An old list must not name new pieces mixed with old ones, whatever ends this process.
  std::error_code error;
  for (const auto& list : {path, surface}) std::filesystem::remove(list, error);
  for (AtomicWriter& file : files) file.commit();
}

}  // namespace holdfast::io
