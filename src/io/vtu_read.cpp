// Reads VTK's XML files, .vtu and .vtp: ASCII, base64 and raw, uncompressed and in zlib blocks
// (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html).
#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <system_error>
#include <utility>

#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/labels.h"
#include "io/mid_nodes.h"
#include "io/pieces.h"
#include "io/text_reader.h"
#include "io/vtk_cells.h"
#include "io/vtk_values.h"
#include "io/vtu_decode.h"
#include "io/xml_reader.h"

namespace holdfast::io {
namespace {

/// Appends the entities of a part, whose vertex i is `number[i]` of the mesh.
void append(MeshData& mesh, MeshData&& part, const std::vector<Index>& number) {
  const auto moved = [&](auto entities) {
    for (auto& entity : entities)
      for (Index& v : entity) v = v == no_entity ? v : number[v];
    return entities;
  };
  const std::vector<int> regions = part.regions.take(part.tetrahedra.size()),
                         facets = part.facet_markers.take(part.facets.size()),
                         segments = part.segment_markers.take(part.segments.size());
  const auto tetrahedra = moved(std::move(part.tetrahedra));
  const auto triangles = moved(std::move(part.facets));
  const auto lines = moved(std::move(part.segments));
  const auto mids_of_tetrahedra = moved(std::move(part.mids.tetrahedra));
  const auto mids_of_facets = moved(std::move(part.mids.facets));
  for (std::size_t i = 0; i < tetrahedra.size(); ++i) {
    if (i < mids_of_tetrahedra.size() && mids_of_tetrahedra[i][0] != no_entity)
      add_second_order(mesh, tetrahedra[i], mids_of_tetrahedra[i], tag_of(regions, i));
    else
      mesh.add_tetrahedron(tetrahedra[i], tag_of(regions, i));
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (i < mids_of_facets.size() && mids_of_facets[i][0] != no_entity)
      add_second_order(mesh, triangles[i], mids_of_facets[i], tag_of(facets, i));
    else
      mesh.add_facet(triangles[i], tag_of(facets, i));
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i < part.mids.segments.size() && part.mids.segments[i] != no_entity)
      add_second_order(mesh, lines[i], number[part.mids.segments[i]], tag_of(segments, i));
    else
      mesh.add_segment(lines[i], tag_of(segments, i));
  }
  mesh.polygons_cut += part.polygons_cut;
  mesh.remarks.insert(mesh.remarks.end(), part.remarks.begin(), part.remarks.end());
  mesh.names.facets.merge(part.names.facets);
  mesh.names.regions.merge(part.names.regions);
  mesh.names.segments.merge(part.names.segments);
  mesh.names.vertices.merge(part.names.vertices);
}

/// A DataArray element, not yet decoded.
struct DataArray {
  XmlTag tag;
  std::size_t content = 0;  ///< offset behind the tag
};

/// What a file says of a second one beside it.
struct VtuBlock {
  MeshData mesh = {};
  bool surface_beside = false;          ///< there should be one with what bounds the tetrahedra
  std::vector<std::int64_t> in_volume;  ///< of this second file: its points' indices in the first
};

class VtuReader {
 public:
  explicit VtuReader(const Source& source) : source_(source), xml_(source) {}

  MeshData read() {
    while (const std::optional<XmlTag> tag = xml_.next()) {
      if (tag->name == "AppendedData") {
        read_appended(*tag);
        has_end_ = true;  // the arrays' own sizes tell whether their data is complete
        break;
      }
      read_tag(*tag);
    }
    if (!has_file_) throw FileError(source_.path, "", "not a VTK XML file: it has no VTKFile element");
    if (!has_end_)
      throw FileError(source_.path, "", "the file does not end with </VTKFile>; it is truncated");
    if (!has_piece_) throw FileError(source_.path, "", "the file has no Piece");
    read_points();
    if (polydata_)
      read_polydata();
    else
      read_cells();
    return mesh_of(source_, std::move(grid_));
  }

  /// What else the file tells, after `read`.
  [[nodiscard]] VtuBlock block() {
    VtuBlock block;
    block.surface_beside = surface_beside_;
    block.in_volume = std::move(in_volume_);
    return block;
  }

  /// The first of these arrays of the points that is there, after `read`.
  PointArray point_array(std::span<const char* const> names) {
    std::string known;
    for (const std::string name : names) {
      known += (known.empty() ? "" : " or ") + in_quotes(name);
      const DataArray* const array = find("PointData/" + name);
      if (array == nullptr) continue;
      const bool is_scalar = array->tag.attribute("NumberOfComponents").empty();
      const std::uint64_t components = is_scalar ? 1 : xml_.number(array->tag, "NumberOfComponents");
      if (components == 0 || components > 9) xml_.fail(array->tag, "the array has no 1 to 9 components");
      return {static_cast<std::size_t>(components),
              values<double>("PointData/" + name, components * points_)};
    }
    throw FileError(source_.path, "", "the points have no array " + known);
  }

 private:
  void read_tag(const XmlTag& tag) {
    constexpr std::string_view kSections[] = {"Points", "Cells", "CellData", "PointData", "FieldData",
                                              "Verts",  "Lines", "Strips",   "Polys"};
    if (tag.name == "VTKFile")
      read_file_attributes(tag);
    else if (tag.name == "Piece")
      read_piece(tag);
    else if (tag.name == "DataArray")
      add_array(tag);
    else if (std::find(std::begin(kSections), std::end(kSections), tag.name) != std::end(kSections))
      section_ = tag.name;
  }

  void read_file_attributes(const XmlTag& tag) {
    has_end_ = tag.closing;
    if (tag.closing) return;
    has_file_ = true;
    const std::string type = tag.attribute("type");
    if (type != "UnstructuredGrid" && type != "PolyData")
      xml_.fail(tag, "the type " + in_quotes(type) + " is not read; only UnstructuredGrid and PolyData are");
    polydata_ = type == "PolyData";
    encoding_.order = tag.attribute("byte_order") == "BigEndian" ? std::endian::big : std::endian::little;
    encoding_.wide_header = tag.attribute("header_type") == "UInt64";
    const std::string compressor = tag.attribute("compressor");
    encoding_.zlib = compressor == "vtkZLibDataCompressor";
    if (!compressor.empty() && !encoding_.zlib)
      xml_.fail(tag,
                "data compressed by " + in_quotes(compressor) + " is not read; save it with zlib or without");
  }

  void read_piece(const XmlTag& tag) {
    if (tag.closing) return;
    if (has_piece_) xml_.fail(tag, "files of several pieces are not read; merge them first");
    has_piece_ = true;
    points_ = xml_.number(tag, "NumberOfPoints");
    if (polydata_)
      for (const std::string kind : {"Verts", "Lines", "Strips", "Polys"}) {
        counts_[kind] = tag.attribute("NumberOf" + kind).empty() ? 0 : xml_.number(tag, "NumberOf" + kind);
        cells_ += counts_[kind];
      }
    else
      cells_ = xml_.number(tag, "NumberOfCells");
  }

  void add_array(const XmlTag& tag) {
    if (tag.closing) return;
    // The points' array may have any name.
    const std::string name = section_ == "Points" ? "" : tag.attribute("Name");
    arrays_.insert({section_ + "/" + name, DataArray{tag, xml_.position()}});
  }

  void read_appended(const XmlTag& tag) {
    const std::size_t mark = source_.bytes.find('_', xml_.position());
    if (mark == std::string_view::npos) xml_.fail(tag, "the appended data does not start with '_'");
    appended_ = mark + 1;
    const std::string encoding = tag.attribute("encoding");
    if (encoding != "raw" && encoding != "base64")
      xml_.fail(tag, "the encoding " + in_quotes(encoding) + " is not read");
    appended_base64_ = encoding == "base64";
  }

  [[nodiscard]] const DataArray* find(const std::string& name) const {
    const auto found = arrays_.find(name);
    return found == arrays_.end() ? nullptr : &found->second;
  }

  /// The values of an array that must exist, `count` of them if that is known.
  template <typename T>
  std::vector<T> values(const std::string& name, std::optional<std::uint64_t> count) {
    const DataArray* array = find(name);
    if (!array) throw FileError(source_.path, "", "the array " + in_quotes(name) + " is missing");
    std::vector<T> result = read_values<T>(*array, count);
    require_count(*array, result.size(), count);
    return result;
  }

  void require_count(const DataArray& array, std::uint64_t size, std::optional<std::uint64_t> count) const {
    if (count && size != *count)
      xml_.fail(array.tag,
                "the array has " + std::to_string(size) + " values instead of " + std::to_string(*count));
  }

  /// The bytes of an array, which are unpacked only if they are as many as they must be.
  [[nodiscard]] std::string decoded(const DataArray& array, bool base64, std::size_t position,
                                    std::optional<std::uint64_t> count) const {
    const std::uint64_t bytes = announced_size(source_, encoding_, base64, position);
    const std::size_t bytes_each = size_of(type_of(array));
    if (bytes % bytes_each != 0) xml_.fail(array.tag, "the array's data ends within a value");
    require_count(array, bytes / bytes_each, count);
    return decode_vtu_array(source_, encoding_, base64, position);
  }

  template <typename T>
  std::vector<T> read_values(const DataArray& array, std::optional<std::uint64_t> count) {
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
      if (offset > source_.bytes.size() - *appended_)
        xml_.fail(array.tag, "the array's data lies beyond the end of the file; it is truncated");
      bytes = decoded(array, appended_base64_, *appended_ + offset, count);
    } else {
      xml_.fail(array.tag, "the format " + in_quotes(format) + " is not read");
    }
    return binary_values<T>(type, bytes, encoding_.order, source_.watch,
                            [&](const std::string& reason) { xml_.fail(array.tag, reason); });
  }

  template <typename T>
  std::vector<T> text_values(const DataArray& array) {
    std::vector<T> result;
    if (array.tag.empty) return result;
    const std::size_t end = source_.bytes.find('<', array.content);
    if (end == std::string_view::npos) xml_.fail(array.tag, "the array does not end; the file is truncated");
    TextReader text({source_.path, source_.bytes.substr(0, end), source_.finite}, '\0');
    text.seek(array.content);
    while (!text.at_end()) result.push_back(text_value<T>(text));
    return result;
  }

  [[nodiscard]] VtkType type_of(const DataArray& array) const {
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

  void read_points() {
    if (points_ > std::numeric_limits<Index>::max())
      throw FileError(source_.path, "", "more points than 32 bits count");
    if (points_ == 0) return;
    grid_.points = points_of(values<double>("Points/", 3 * points_));
  }

  void read_tags() {
    const std::string regions = array_of("region", kRegionArrays),
                      markers = array_of("marker", kMarkerArrays);
    for (const auto& [path, array] : arrays_) {
      const bool of_points = path.starts_with("PointData/");
      const std::string name = array.tag.attribute("Name");
      if ((of_points || path.starts_with("CellData/")) && !is_known_array(name) && path != regions &&
          path != markers)
        grid_.other_arrays.push_back(name);
    }
    if (!regions.empty()) grid_.regions = values<int>(regions, cells_);
    if (!markers.empty()) grid_.markers = values<int>(markers, cells_);
    if (find("PointData/marker")) grid_.point_markers = values<int>("PointData/marker", points_);
    if (const std::string name = std::string("PointData/") + kVolumeVertex; find(name))
      in_volume_ = values<std::int64_t>(name, points_);
    read_names();
  }

  /// The cells' array of this name, or else the first with another one that holds integers; or "".
  [[nodiscard]] std::string array_of(const std::string& own, std::span<const std::string_view> others) const {
    if (find("CellData/" + own)) return "CellData/" + own;
    for (const std::string_view other : others) {
      const std::string name = "CellData/" + std::string(other);
      if (const DataArray* array = find(name); array != nullptr && holds_integers(*array)) return name;
    }
    return {};
  }

  [[nodiscard]] static bool holds_integers(const DataArray& array) {
    const std::string components = array.tag.attribute("NumberOfComponents");
    return array.tag.attribute("type").find("Int") != std::string::npos &&
           (components.empty() || components == "1");
  }

  void read_names() {
    VtkNames names;
    for (const auto& [path, array] : arrays_) {
      if (!path.starts_with("FieldData/") || array.tag.attribute("type").find("Int") == std::string::npos)
        continue;
      const std::string name = array.tag.attribute("Name");
      if (name == kSurfaceBeside)
        surface_beside_ = true;
      else if (name != kInterfaces)
        names.add(name, read_values<std::int64_t>(array, std::nullopt));
    }
    grid_.names = names.take();
  }

  void read_cells() {
    if (cells_ == 0) return;
    grid_.types = values<std::uint8_t>("Cells/types", cells_);
    grid_.ends = values<std::int64_t>("Cells/offsets", cells_);
    grid_.connectivity = values<std::int64_t>("Cells/connectivity", last_end(grid_.ends));
    read_tags();
  }

  /// How many corners cells with these ends have; that these do not descend is checked later.
  static std::uint64_t last_end(const std::vector<std::int64_t>& ends) {
    return ends.empty() || ends.back() < 0 ? 0 : static_cast<std::uint64_t>(ends.back());
  }

  void read_polydata() {
    struct Section {
      const char* name;
      VtkCell type;
    };
    constexpr Section kSections[] = {{"Verts", VtkCell::poly_vertex},
                                     {"Lines", VtkCell::poly_line},
                                     {"Polys", VtkCell::polygon},
                                     {"Strips", VtkCell::triangle_strip}};
    // In the order in which cell data lists them.
    for (const Section& section : kSections) {
      const std::string name = section.name;
      if (!find(name + "/offsets")) continue;
      VtkGrid part;
      part.ends = values<std::int64_t>(name + "/offsets", counts_[name]);
      part.connectivity = values<std::int64_t>(name + "/connectivity", last_end(part.ends));
      for (const std::int64_t end : part.ends)
        if (end < 0 || static_cast<std::uint64_t>(end) > part.connectivity.size())
          throw FileError(source_.path, "", "an offset of " + name + " is out of range");
      part.types.assign(part.ends.size(), static_cast<std::uint8_t>(section.type));
      append_cells(grid_, part);
    }
    read_tags();
  }

  Source source_;
  XmlReader xml_;
  VtuEncoding encoding_;
  bool has_file_ = false, has_piece_ = false, has_end_ = false, polydata_ = false;
  std::uint64_t points_ = 0, cells_ = 0;
  std::map<std::string, std::uint64_t> counts_;  ///< of the cells of polygonal data, by section
  std::string section_;                          ///< the element that holds the current arrays
  std::map<std::string, DataArray> arrays_;      ///< by "section/name"
  std::optional<std::size_t> appended_;          ///< offset of the appended data
  bool appended_base64_ = false;
  VtkGrid grid_;
  bool surface_beside_ = false;
  std::vector<std::int64_t> in_volume_;
};

VtuBlock read_block(const Source& source) {
  VtuReader reader(source);
  MeshData mesh = reader.read();
  VtuBlock block = reader.block();
  block.mesh = std::move(mesh);
  return block;
}

/// Puts a surface in whose points know their indices in the volume.
void attach(MeshData& mesh, VtuBlock&& part, const std::filesystem::path& path) {
  std::vector<Index> number;
  for (std::size_t i = 0; i < part.in_volume.size(); ++i) {
    const std::int64_t v = part.in_volume[i];
    if (v < 0 || static_cast<std::uint64_t>(v) >= mesh.vertices.size() ||
        std::memcmp(&mesh.vertices[static_cast<std::size_t>(v)], &part.mesh.vertices[i], sizeof(Point)) != 0)
      throw FileError(path, "point " + std::to_string(i),
                      "is none of the volume's; the two files are not of one run");
    number.push_back(static_cast<Index>(v));
  }
  append(mesh, std::move(part.mesh), number);
}

}  // namespace

MeshData read_vtu(const Source& source) {
  VtuBlock block = read_block(source);
  if (!block.surface_beside) return std::move(block.mesh);
  std::filesystem::path beside = surface_beside(without_gz(source.path));
  std::error_code error;
  if (!std::filesystem::exists(beside, error)) beside += ".gz";
  if (!can_have_a_file_beside(source.path) || !std::filesystem::exists(beside, error)) {
    block.mesh.remarks.push_back({RemarkKind::left_out, 1,
                                  "the facets and segments, which are in " +
                                      surface_beside(without_gz(source.path)).filename().string() +
                                      ", are left out: this file is not there"});
    return std::move(block.mesh);
  }
  const FileBytes bytes(beside, source.watch);
  attach(block.mesh, read_block({beside, bytes.view(), source.finite, source.watch}), beside);
  return std::move(block.mesh);
}

MeshData read_vtm(const Source& source) {
  XmlReader xml(source);
  MeshData mesh;
  bool is_index = false;
  std::set<std::filesystem::path> seen;
  while (const std::optional<XmlTag> tag = xml.next()) {
    if (tag->name == "VTKFile" && !tag->closing) is_index = tag->attribute("type") == "vtkMultiBlockDataSet";
    if (tag->name != "DataSet" || tag->closing || tag->attribute("file").empty()) continue;
    if (!is_index) break;
    const std::filesystem::path part = source.path.parent_path() / tag->attribute("file");
    if (!seen.insert(part).second) xml.fail(*tag, "the file is named twice");
    if (const std::string ending = lower(part.extension().string()); ending != ".vtu" && ending != ".vtp")
      xml.fail(*tag, "a block in the format " + in_quotes(ending) + " is not read; only .vtu and .vtp are");
    const FileBytes bytes(part, source.watch);
    VtuBlock block = read_block({part, bytes.view(), source.finite, source.watch});
    if (!block.in_volume.empty() && !seen.empty() && !mesh.vertices.empty()) {
      attach(mesh, std::move(block), part);
      continue;
    }
    std::vector<Index> number(block.mesh.vertices.size());
    if (number.size() > no_entity - mesh.vertices.size()) xml.fail(*tag, "more points than 32 bits count");
    std::iota(number.begin(), number.end(), static_cast<Index>(mesh.vertices.size()));
    const std::vector<int> markers = block.mesh.vertex_markers.take(number.size());
    for (std::size_t i = 0; i < number.size(); ++i)
      mesh.add_vertex(block.mesh.vertices[i], tag_of(markers, i));
    append(mesh, std::move(block.mesh), number);
  }
  if (!is_index)
    throw FileError(source.path, "", "not a VTK multi-block file: it has no VTKFile of this type");
  if (seen.empty()) throw FileError(source.path, "", "the file names no blocks");
  return mesh;
}

MeshData read_vtu(const Source& source, std::span<const char* const> names, PointArray& array) {
  VtuReader reader(source);
  MeshData mesh = reader.read();
  array = reader.point_array(names);
  return mesh;
}

}  // namespace holdfast::io
