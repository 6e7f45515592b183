// Writes VTK's XML unstructured grids (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html):
// appended raw data, each array in zlib blocks with a header of 64-bit sizes.
#include <zlib.h>

#include <bit>
#include <cstring>
#include <limits>
#include <utility>

#include "io/vtk_cells.h"
#include "io/vtu_arrays.h"
#include "mesh/parallel.h"

namespace holdfast::io {
namespace {

/// Large enough that block headers cost nothing, small enough for readers that fetch single blocks.
constexpr std::size_t kBlock = std::size_t{1} << 18;

void append(std::string& bytes, std::uint64_t value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof raw);
}

std::string deflated(std::string_view block) {
  std::string room(compressBound(kBlock), '\0');
  uLongf size = room.size();
  // Level 1: half the time of the default for 5 % more bytes. It cannot fail: the room suffices.
  compress2(reinterpret_cast<Bytef*>(room.data()), &size, reinterpret_cast<const Bytef*>(block.data()),
            block.size(), 1);
  return room.substr(0, size);
}

/// One array as the appended section holds it: sizes, then the data.
std::string encoded(std::string_view data, bool compress, const Threads& threads) {
  std::string result;
  if (!compress) {
    append(result, data.size());
    return result.append(data);
  }
  std::vector<std::string> blocks((data.size() + kBlock - 1) / kBlock);
  parallel(threads, blocks.size(),
           [&](std::size_t k) { blocks[k] = deflated(data.substr(k * kBlock, kBlock)); });
  append(result, blocks.size());
  append(result, kBlock);
  append(result, data.size() % kBlock);
  for (const std::string& block : blocks) append(result, block.size());
  for (const std::string& block : blocks) result.append(block);
  return result;
}

}  // namespace

void write_vtu_arrays(AtomicWriter& out, const VtuArrays& arrays, const WriteOptions& options) {
  const Threads threads = Threads(options.threads).polling([&] { step(out.watch()); });
  std::string data;
  const auto array = [&](const VtuArray& a) {
    out << "<DataArray type=\"" << a.type << "\" Name=\"" << a.name << '"';
    // Left out for scalars: meshio would give their values a second dimension.
    if (a.components != 1) out << " NumberOfComponents=\"" << std::uint64_t{a.components} << '"';
    out << " format=\"appended\" offset=\"" << std::uint64_t{data.size()} << "\"/>\n";
    data +=
        encoded({reinterpret_cast<const char*>(a.bytes.data()), a.bytes.size()}, options.compress, threads);
  };
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\""
      << (std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian")
      << "\" header_type=\"UInt64\"" << (options.compress ? " compressor=\"vtkZLibDataCompressor\"" : "")
      << ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" << std::uint64_t{arrays.points}
      << "\" NumberOfCells=\"" << std::uint64_t{arrays.cells} << "\">\n<Points>\n";
  array(arrays.coordinates);
  out << "</Points>\n<Cells>\n";
  array(arrays.connectivity);
  array(arrays.offsets);
  array(arrays.types);
  out << "</Cells>\n<CellData>\n";
  for (const VtuArray& a : arrays.cell_data) array(a);
  out << "</CellData>\n";
  if (!arrays.point_data.empty()) {
    out << "<PointData>\n";
    for (const VtuArray& a : arrays.point_data) array(a);
    out << "</PointData>\n";
  }
  out << "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_" << data
      << "\n</AppendedData>\n</VTKFile>\n";
}

void write_vtu(AtomicWriter& out, const Volume& volume, const WriteOptions& options) {
  VtuCells cells;
  cells.reserve(vtk_cell_count(volume),
                4 * volume.tetrahedra.size() + 3 * volume.facets.size() + 2 * volume.segments.size());
  std::vector<std::int32_t> kinds, regions, markers;
  for (auto* array : {&kinds, &regions, &markers}) array->reserve(vtk_cell_count(volume));
  visit_vtk_cells(volume,
                  [&](VtkCell type, std::span<const Index> corners, int kind, int region, int marker) {
                    beat(out.watch());
                    cells.add(type, corners);
                    kinds.push_back(kind);
                    regions.push_back(region);
                    markers.push_back(marker);
                  });
  std::vector<VtuArray> point_data;
  if (!volume.input_vertices.empty()) point_data.push_back(vtu_array("input_vertex", volume.input_vertices));
  // The region first: it is what viewers colour by, and what meshio keeps where it keeps one array.
  VtuArrays arrays = cells.arrays(volume.vertices, {vtu_array("region", regions),
                                                    vtu_array("marker", markers), vtu_array("kind", kinds)});
  if (!volume.vertex_markers.empty()) point_data.push_back(vtu_array("marker", volume.vertex_markers));
  arrays.point_data = std::move(point_data);
  write_vtu_arrays(out, arrays, options);
}

}  // namespace holdfast::io
