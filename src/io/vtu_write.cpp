// Writes VTK's XML unstructured grids (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html):
// appended raw data, each array in zlib blocks with a header of 64-bit sizes.
#include <bit>
#include <limits>
#include <utility>

#include "io/vtk_cells.h"
#include "io/vtu_arrays.h"
#include "io/vtu_blocks.h"
#include "io/xml_reader.h"
#include "mesh/parallel.h"

namespace holdfast::io {
namespace {

/// An array as in the appended section: sizes, then the data.
std::string encoded(std::string_view data, bool compress, const Threads& threads) {
  std::string result;
  if (!compress) {
    append_vtu_size(result, data.size());
    return result.append(data);
  }
  const std::vector<std::string> blocks = deflated_blocks(data, threads);
  std::vector<std::uint64_t> sizes;
  for (const std::string& block : blocks) sizes.push_back(block.size());
  result = vtu_block_header(data.size(), sizes);
  for (const std::string& block : blocks) result.append(block);
  return result;
}

}  // namespace

void write_vtu_arrays(AtomicWriter& out, const VtuArrays& arrays, const WriteOptions& options) {
  const Threads threads = Threads(options.threads).polling([&] { step(out.watch()); });
  std::string data;
  const auto array = [&](const VtuArray& a) {
    out << "<DataArray type=\"" << a.type << "\" Name=\"" << a.name << '"';
    // Omitted for scalars, because meshio would give their values a second dimension.
    if (a.components != 1) out << " NumberOfComponents=\"" << std::uint64_t{a.components} << '"';
    out << " format=\"appended\" offset=\"" << std::uint64_t{data.size()} << "\"/>\n";
    data +=
        encoded({reinterpret_cast<const char*>(a.bytes.data()), a.bytes.size()}, options.compress, threads);
  };
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\""
      << (std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian")
      << "\" header_type=\"UInt64\"" << (options.compress ? " compressor=\"vtkZLibDataCompressor\"" : "")
      << ">\n<UnstructuredGrid>\n";
  if (!arrays.field_data.empty() || !arrays.tables.empty()) {
    out << "<FieldData>\n";
    for (const auto& [name, values] : arrays.field_data) {
      out << "<DataArray type=\"Int32\" Name=\"" << escaped(name)
          << "\" NumberOfComponents=\"2\" NumberOfTuples=\"" << std::uint64_t{values.size()}
          << "\" format=\"ascii\">";
      for (const auto& [id, dimension] : values) out << id << ' ' << dimension << ' ';
      out << "</DataArray>\n";
    }
    for (const VtuTable& table : arrays.tables) {
      out << "<DataArray type=\"Int64\" Name=\"" << table.name << "\" NumberOfComponents=\""
          << std::uint64_t{table.columns} << "\" NumberOfTuples=\""
          << std::uint64_t{table.values.size() / table.columns} << "\" format=\"ascii\">";
      for (const std::int64_t value : table.values) out << value << ' ';
      out << "</DataArray>\n";
    }
    out << "</FieldData>\n";
  }
  out << "<Piece NumberOfPoints=\"" << std::uint64_t{arrays.points} << "\" NumberOfCells=\""
      << std::uint64_t{arrays.cells} << "\">\n<Points>\n";
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

}  // namespace holdfast::io
