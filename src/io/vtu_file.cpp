#include "io/vtu_file.h"

#include <algorithm>
#include <iterator>

#include "io/text_reader.h"
#include "io/xz_block.h"
#include "text/count.h"

namespace holdfast::io {

/// The state of parsing.
struct VtuFile::Seen {
  bool file = false, end = false;
  bool in_piece = false;
  std::string section;                      ///< the element that holds the current arrays
  std::map<std::string, DataArray> common;  ///< outside all pieces
};

VtuFile::VtuFile(const Source& source) : source_(source), xml_(source) {
  Seen seen;
  while (const std::optional<XmlTag> tag = xml_.next()) {
    if (tag->name == "AppendedData") {
      read_appended(*tag);
      seen.end = true;  // the arrays' own sizes show whether their data is complete
      break;
    }
    read_tag(*tag, seen);
  }
  if (!seen.file) throw FileError(source_.path, "", "not a VTK XML file: it has no VTKFile element");
  if (!seen.end) throw FileError(source_.path, "", "the file does not end with </VTKFile>; it is truncated");
  if (pieces_.empty()) throw FileError(source_.path, "", "the file has no Piece");
  for (Piece& piece : pieces_) piece.arrays.insert(seen.common.begin(), seen.common.end());
}

void VtuFile::read_tag(const XmlTag& tag, Seen& seen) {
  constexpr std::string_view kSections[] = {"Points", "Cells", "CellData", "PointData", "FieldData",
                                            "Verts",  "Lines", "Strips",   "Polys"};
  if (tag.name == "VTKFile")
    read_file_attributes(tag, seen);
  else if (tag.name == "Piece")
    read_piece(tag, seen);
  else if (tag.name == "DataArray" && !tag.closing)
    // The array of points may have any name.
    (seen.in_piece ? pieces_.back().arrays : seen.common)
        .insert({seen.section + "/" + (seen.section == "Points" ? "" : tag.attribute("Name")),
                 DataArray{tag, xml_.position()}});
  else if (tag.name == "Array" && !tag.closing && seen.in_piece && seen.section.ends_with("Data"))
    pieces_.back().strings.push_back(tag.attribute("Name"));
  else if (std::find(std::begin(kSections), std::end(kSections), tag.name) != std::end(kSections))
    seen.section = tag.name;
}

void VtuFile::read_file_attributes(const XmlTag& tag, Seen& seen) {
  seen.end = tag.closing;
  if (tag.closing) return;
  seen.file = true;
  const std::string type = tag.attribute("type");
  if (type != "UnstructuredGrid" && type != "PolyData")
    xml_.fail(tag, "the type " + in_quotes(type) + " is not read; only UnstructuredGrid and PolyData are");
  polydata_ = type == "PolyData";
  encoding_.order = tag.attribute("byte_order") == "BigEndian" ? std::endian::big : std::endian::little;
  encoding_.wide_header = tag.attribute("header_type") == "UInt64";
  const std::string compressor = tag.attribute("compressor");
  if (compressor == "vtkZLibDataCompressor")
    encoding_.compressor = VtuCompressor::zlib;
  else if (compressor == "vtkLZ4DataCompressor")
    encoding_.compressor = VtuCompressor::lz4;
  else if (compressor == "vtkLZMADataCompressor" && has_xz())
    encoding_.compressor = VtuCompressor::lzma;
  else if (!compressor.empty())
    xml_.fail(tag, "data compressed by " + in_quotes(compressor) + " is not read; save it with " +
                       (has_xz() ? "zlib, LZ4 or LZMA" : "zlib or LZ4") + ", or without");
}

void VtuFile::read_piece(const XmlTag& tag, Seen& seen) {
  seen.in_piece = !tag.closing && !tag.empty;
  if (tag.closing) return;
  Piece& piece = pieces_.emplace_back();
  piece.points = xml_.number(tag, "NumberOfPoints");
  if (polydata_)
    for (const std::string kind : {"Verts", "Lines", "Strips", "Polys"}) {
      piece.counts[kind] = tag.attribute("NumberOf" + kind).empty() ? 0 : xml_.number(tag, "NumberOf" + kind);
      piece.cells += piece.counts[kind];
    }
  else
    piece.cells = xml_.number(tag, "NumberOfCells");
}

void VtuFile::read_appended(const XmlTag& tag) {
  const std::size_t mark = source_.bytes.find('_', xml_.position());
  if (mark == std::string_view::npos) xml_.fail(tag, "the appended data does not start with '_'");
  const std::string encoding = tag.attribute("encoding");
  if (encoding != "raw" && encoding != "base64")
    xml_.fail(tag, "the encoding " + in_quotes(encoding) + " is not read");
  appended_ = Appended{mark + 1, encoding == "base64"};
}

const DataArray* VtuFile::find(const std::string& name) const {
  const auto found = arrays().find(name);
  return found == arrays().end() ? nullptr : &found->second;
}

std::uint64_t VtuFile::components(const DataArray& array) const {
  if (array.tag.attribute("NumberOfComponents").empty()) return 1;
  const std::uint64_t components = xml_.number(array.tag, "NumberOfComponents");
  if (components == 0 || components > 9) xml_.fail(array.tag, "the array has no 1 to 9 components");
  return components;
}

void VtuFile::require_count(const DataArray& array, std::uint64_t size,
                            std::optional<std::uint64_t> count) const {
  if (count && size != *count)
    xml_.fail(array.tag, "the array has " + counted(size, "value") + " instead of " + std::to_string(*count));
}

VtkType VtuFile::type_of(const DataArray& array) const {
  static const std::map<std::string_view, VtkType> kTypes = {
      {"Int8", VtkType::int8},      {"UInt8", VtkType::uint8},   {"Int16", VtkType::int16},
      {"UInt16", VtkType::uint16},  {"Int32", VtkType::int32},   {"UInt32", VtkType::uint32},
      {"Int64", VtkType::int64},    {"UInt64", VtkType::uint64}, {"Float32", VtkType::float32},
      {"Float64", VtkType::float64}};
  const std::string name = array.tag.attribute("type");
  const auto found = kTypes.find(name);
  if (found == kTypes.end()) xml_.fail(array.tag, "values of type " + in_quotes(name) + " are not read");
  return found->second;
}

// The bytes of an array, which are decompressed only if their announced number is right.
std::string VtuFile::decoded(const DataArray& array, bool base64, std::size_t position,
                             std::optional<std::uint64_t> count) const {
  const std::uint64_t bytes = announced_size(source_, encoding_, base64, position);
  const std::size_t bytes_each = size_of(type_of(array));
  if (bytes % bytes_each != 0) xml_.fail(array.tag, "the array's data ends within a value");
  require_count(array, bytes / bytes_each, count);
  return decode_vtu_array(source_, encoding_, base64, position);
}

template <typename T>
std::vector<T> VtuFile::text_values(const DataArray& array) const {
  std::vector<T> result;
  if (array.tag.empty) return result;
  const std::size_t end = source_.bytes.find('<', array.content);
  if (end == std::string_view::npos) xml_.fail(array.tag, "the array does not end; the file is truncated");
  TextReader text({source_.path, source_.bytes.substr(0, end), source_.finite}, '\0');
  text.seek(array.content);
  while (!text.at_end()) result.push_back(text_value<T>(text));
  return result;
}

template <typename T>
std::vector<T> VtuFile::read_values(const DataArray& array, std::optional<std::uint64_t> count) const {
  const std::string format = array.tag.attribute("format");
  if (format == "ascii" || format.empty()) return text_values<T>(array);
  const VtkType type = type_of(array);
  std::string bytes;
  if (format == "binary") {
    const std::size_t start = source_.bytes.find_first_not_of(" \t\r\n", array.content);
    bytes = decoded(array, true, std::min(start, source_.bytes.size()), count);
  } else if (format == "appended") {
    if (!appended_) xml_.fail(array.tag, "the appended data is missing; the file is truncated");
    const std::uint64_t offset = xml_.number(array.tag, "offset");
    if (offset > source_.bytes.size() - appended_->offset)
      xml_.fail(array.tag, "the array's data lies beyond the end of the file; it is truncated");
    bytes = decoded(array, appended_->base64, appended_->offset + offset, count);
  } else {
    xml_.fail(array.tag, "the format " + in_quotes(format) + " is not read");
  }
  return binary_values<T>(type, bytes, encoding_.order, source_.watch,
                          [&](const std::string& reason) { xml_.fail(array.tag, reason); });
}

template <typename T>
std::vector<T> VtuFile::values(const std::string& name, std::optional<std::uint64_t> count) const {
  const DataArray* array = find(name);
  if (!array) throw FileError(source_.path, "", "the array " + in_quotes(name) + " is missing");
  std::vector<T> result = read_values<T>(*array, count);
  require_count(*array, result.size(), count);
  return result;
}

template std::vector<double> VtuFile::values(const std::string&, std::optional<std::uint64_t>) const;
template std::vector<int> VtuFile::values(const std::string&, std::optional<std::uint64_t>) const;
template std::vector<std::int64_t> VtuFile::values(const std::string&, std::optional<std::uint64_t>) const;
template std::vector<std::uint8_t> VtuFile::values(const std::string&, std::optional<std::uint64_t>) const;

}  // namespace holdfast::io
