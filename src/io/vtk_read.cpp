// Reads legacy VTK files, ASCII and binary, versions 1 to 5 (VTK User's Guide, "VTK File Formats"; version
// 5.1 separates offsets and connectivity): unstructured grids and polygonal data.
#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "io/formats.h"
#include "io/text_reader.h"
#include "io/turn.h"
#include "io/vtk_cells.h"
#include "io/vtk_values.h"
#include "text/count.h"

namespace holdfast::io {
namespace {

VtkType type_of(const TextReader& text, std::string_view name) {
  struct Name {
    std::string_view name;
    VtkType type;
  };
  constexpr Name kNames[] = {{"char", VtkType::int8},
                             {"signed_char", VtkType::int8},
                             {"unsigned_char", VtkType::uint8},
                             {"short", VtkType::int16},
                             {"unsigned_short", VtkType::uint16},
                             {"int", VtkType::int32},
                             {"unsigned_int", VtkType::uint32},
                             {"long", VtkType::int64},
                             {"unsigned_long", VtkType::uint64},
                             {"float", VtkType::float32},
                             {"double", VtkType::float64},
                             {"vtktypeint8", VtkType::int8},
                             {"vtktypeuint8", VtkType::uint8},
                             {"vtktypeint16", VtkType::int16},
                             {"vtktypeuint16", VtkType::uint16},
                             {"vtktypeint32", VtkType::int32},
                             {"vtktypeuint32", VtkType::uint32},
                             {"vtktypeint64", VtkType::int64},
                             {"vtktypeuint64", VtkType::uint64},
                             {"vtkidtype", VtkType::int32}};  // VTK writes ids as 32 bits before version 5.1
  const std::string wanted = lower(name);
  for (const Name& entry : kNames)
    if (entry.name == wanted) return entry.type;
  text.fail("values of type " + in_quotes(name) + " are not read");
}

/// Decodes the %XX of a word.
std::string decoded(std::string_view word) {
  std::string result;
  for (std::size_t i = 0; i < word.size(); ++i) {
    unsigned byte = 0;
    const char* const digits = word.data() + i + 1;
    if (word[i] == '%' && word.size() - i > 2 &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      result += static_cast<char>(byte);
      i += 2;
    } else {
      result += word[i];
    }
  }
  return result;
}

class VtkReader {
 public:
  explicit VtkReader(const Source& source) : text_(source, '\0') {}

  MeshData read() {
    read_header();
    while (!text_.at_end()) read_section();
    if (!has_points_) throw FileError(text_.source().path, "", "the file has no POINTS");
    for (const VtkGrid& part : parts_) append_cells(grid_, part);
    take_other_ids(grid_.regions, kRegionArrays);
    take_other_ids(grid_.markers, kMarkerArrays);
    for (const auto& [name, ids] : other_ids_)
      if (!taken_.contains(name) && !is_known_array(name)) grid_.other_arrays.push_back(name);
    grid_.names = names_.take();
    return mesh_of(text_.source(), std::move(grid_));
  }

 private:
  void read_header() {
    if (!lower(text_.rest_of_line()).starts_with("# vtk datafile version"))
      text_.fail("not a legacy VTK file: it does not start with '# vtk DataFile Version'");
    text_.skip_line();  // the title
    const std::string format = lower(text_.word("ASCII or BINARY"));
    if (format != "ascii" && format != "binary")
      text_.fail("expected ASCII or BINARY, found " + in_quotes(format));
    binary_ = format == "binary";
  }

  void read_section() {
    const std::string keyword = lower(text_.word("a keyword"));
    if (keyword == "dataset") {
      const std::string dataset = lower(text_.word("a dataset"));
      if (dataset != "unstructured_grid" && dataset != "polydata")
        text_.fail("the dataset " + in_quotes(dataset) +
                   " is not read; only UNSTRUCTURED_GRID and POLYDATA are");
    } else if (keyword == "points") {
      read_points();
    } else if (keyword == "cells") {
      read_cells();
    } else if (keyword == "vertices") {
      read_typed_cells(VtkCell::poly_vertex);
    } else if (keyword == "lines") {
      read_typed_cells(VtkCell::poly_line);
    } else if (keyword == "polygons") {
      read_typed_cells(VtkCell::polygon);
    } else if (keyword == "triangle_strips") {
      read_typed_cells(VtkCell::triangle_strip);
    } else if (keyword == "cell_types") {
      grid_.types = values<std::uint8_t>(VtkType::int32, text_.count("the number of cells", 1));
    } else if (keyword == "cell_data" || keyword == "point_data") {
      of_cells_ = keyword == "cell_data";
      of_points_ = !of_cells_;
      tuples_ = tuples();
    } else if (keyword == "field") {
      read_field();
    } else if (keyword == "metadata") {
      skip_metadata();
    } else {
      read_attribute(keyword);
    }
  }

  /// The number of tuples of arrays that may be absent, so it is not checked against the file's size.
  std::uint64_t tuples() {
    const std::int64_t value = text_.integer("the number of values");
    if (value < 0 || value > std::numeric_limits<Index>::max())
      text_.fail("the number of values is negative or beyond 32 bits: " + std::to_string(value));
    return static_cast<std::uint64_t>(value);
  }

  /// Reads `count` values of a type as T; binary data starts in the next line.
  template <typename T>
  std::vector<T> values(VtkType type, std::uint64_t count) {
    const std::size_t bytes_each = binary_ ? size_of(type) : 2;
    if (binary_) text_.skip_line();
    const std::size_t left = text_.remaining().size() + (binary_ ? 0 : 1);
    if (count > left / bytes_each)
      text_.fail(counted(count, "value is", "values are") + " announced, but only " +
                 counted(text_.remaining().size(), "byte follows", "bytes follow") +
                 "; the file is truncated or damaged");
    if (binary_) {
      const std::string_view bytes = text_.remaining().substr(0, count * bytes_each);
      const std::size_t start = text_.position();
      text_.seek(start + bytes.size());
      return binary_values<T>(type, bytes, std::endian::big, text_.source().watch,
                              [&](const std::string& reason) {
                                throw FileError(text_.source().path, "byte " + std::to_string(start), reason);
                              });
    }
    std::vector<T> result;
    result.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i) result.push_back(text_value<T>(text_));
    return result;
  }

  void read_points() {
    if (std::exchange(has_points_, true)) text_.fail("a second section POINTS");
    const std::uint64_t count = text_.count("the number of points", 1);
    const VtkType type = type_of(text_, text_.word("a type"));
    grid_.points = points_of(values<double>(type, 3 * count));
  }

  /// Appends the cells of a section; returns their number.
  std::size_t read_cells() {
    const std::size_t count = text_.count("the number of cells", 1);
    const std::size_t numbers = text_.count("the size of the cells", 1);
    const std::size_t start = text_.position();
    if (!text_.at_end() && lower(text_.word("OFFSETS")) == "offsets") return read_offsets(count, numbers);
    text_.seek(start);
    const std::vector<std::int64_t> list = values<std::int64_t>(VtkType::int32, numbers);
    std::size_t next = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (next == list.size() || list[next] < 0 ||
          static_cast<std::uint64_t>(list[next]) >= list.size() - next)
        text_.fail("the list of cells is shorter than its cells");
      const std::size_t end = next + 1 + static_cast<std::size_t>(list[next]);
      grid_.connectivity.insert(grid_.connectivity.end(),
                                list.begin() + static_cast<std::ptrdiff_t>(next) + 1,
                                list.begin() + static_cast<std::ptrdiff_t>(end));
      grid_.ends.push_back(static_cast<std::int64_t>(grid_.connectivity.size()));
      next = end;
    }
    if (next != list.size()) text_.fail("the list of cells is longer than its cells");
    return count;
  }

  std::size_t read_offsets(std::size_t count, std::size_t numbers) {
    VtkType type = type_of(text_, text_.word("a type"));
    const std::vector<std::int64_t> offsets = values<std::int64_t>(type, count);
    if (lower(text_.word("CONNECTIVITY")) != "connectivity") text_.fail("expected CONNECTIVITY");
    type = type_of(text_, text_.word("a type"));
    const std::vector<std::int64_t> corners = values<std::int64_t>(type, numbers);
    const auto base = static_cast<std::int64_t>(grid_.connectivity.size());
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      if (offsets[i] < 0 || static_cast<std::uint64_t>(offsets[i]) > corners.size())
        text_.fail("the offset " + std::to_string(offsets[i]) + " is out of range");
      if (i > 0) grid_.ends.push_back(base + offsets[i]);
    }
    grid_.connectivity.insert(grid_.connectivity.end(), corners.begin(), corners.end());
    return offsets.empty() ? 0 : offsets.size() - 1;
  }

  /// Sections of polygonal data may come in any order, but their cells are numbered by kind.
  void read_typed_cells(VtkCell type) {
    VtkGrid& part = parts_[type == VtkCell::poly_vertex ? 0
                           : type == VtkCell::poly_line ? 1
                           : type == VtkCell::polygon   ? 2
                                                        : 3];
    std::swap(grid_.ends, part.ends);
    std::swap(grid_.connectivity, part.connectivity);
    const std::size_t count = read_cells();
    std::swap(grid_.ends, part.ends);
    std::swap(grid_.connectivity, part.connectivity);
    part.types.insert(part.types.end(), count, static_cast<std::uint8_t>(type));
  }

  /// Reads an array after its name; keeps it if it has the cells' regions or markers.
  void read_array(const std::string& name, VtkType type, std::uint64_t count) {
    if (of_cells_ && name == "region")
      grid_.regions = values<int>(type, count);
    else if (of_cells_ && name == "marker")
      grid_.markers = values<int>(type, count);
    else if (of_points_ && name == "marker")
      grid_.point_markers = values<int>(type, count);
    else
      skip_array(name, type, count);
  }

  /// Uses ids under a foreign name if there are none under ours.
  void take_other_ids(std::vector<int>& ids, std::span<const std::string_view> names) {
    for (const std::string_view name : names) {
      if (!ids.empty()) return;
      const auto found = other_ids_.find(std::string(name));
      if (found == other_ids_.end() || found->second.size() != grid_.types.size()) continue;
      ids = found->second;
      taken_.insert(found->first);
    }
  }

  static bool is_integer(VtkType type) { return type != VtkType::float32 && type != VtkType::float64; }

  void skip_array(const std::string& name, VtkType type, std::uint64_t count) {
    const auto is_one_of = [&](const auto& names) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (of_cells_ && is_integer(type) && (is_one_of(kRegionArrays) || is_one_of(kMarkerArrays))) {
      other_ids_[name] = values<int>(type, count);
      return;
    }
    if (!of_cells_ && !of_points_ && is_integer(type)) {
      const std::vector<std::int64_t> pairs = values<std::int64_t>(type, count);
      return names_.add(decoded(name), pairs);
    }
    static_cast<void>(values<double>(type, count));
    if (!is_known_array(name)) grid_.other_arrays.push_back(name);
  }

  void read_field() {
    static_cast<void>(text_.word("a name"));
    const std::size_t arrays = text_.count("the number of arrays", 1);
    for (std::size_t i = 0; i < arrays; ++i) {
      std::string name(text_.word("a name"));
      while (lower(name) == "metadata") {  // of the array before
        skip_metadata();
        name = text_.word("a name");
      }
      const std::uint64_t components = text_.count("the number of components", 1);
      const std::uint64_t tuples = this->tuples();
      if (skip_strings_or_bits(name, components * tuples)) continue;
      const VtkType type = type_of(text_, text_.word("a type"));
      read_array(name, type, components * tuples);
    }
  }

  /// Skips an array of strings or bits, before whose type the text stands; returns false for other types.
  bool skip_strings_or_bits(const std::string& name, std::uint64_t count) {
    const std::size_t start = text_.position();
    const std::string type = lower(text_.word("a type"));
    if (type == "bit") {
      static_cast<void>(values<double>(VtkType::uint8, binary_ ? (count + 7) / 8 : count));
    } else if (type == "string") {
      text_.skip_line();
      for (std::uint64_t i = 0; i < count; ++i) {
        if (text_.remaining().empty()) text_.fail_truncated("a string");
        binary_ ? skip_counted_string() : text_.skip_line();
      }
    } else {
      text_.seek(start);
      return false;
    }
    grid_.other_arrays.push_back(name);
    return true;
  }

  /// The upper two bits of the first byte give the size of the length: 3 for one byte, 2 for two, 1 for four,
  /// 0 for eight.
  void skip_counted_string() {
    const std::string_view bytes = text_.remaining();
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
    const std::size_t width = std::size_t{1} << (3 - (byte(0) >> 6));
    if (bytes.size() < width) text_.fail_truncated("the length of a string");
    std::uint64_t length = byte(0) & 0x3F;
    for (std::size_t i = 1; i < width; ++i) length = length << 8 | byte(i);
    if (length > bytes.size() - width) text_.fail_truncated("a string");
    text_.seek(text_.position() + width + length);
  }

  /// Skips a block that ends with an empty line.
  void skip_metadata() {
    text_.skip_line();
    while (!text_.remaining().empty() && !text_.at_line_end()) text_.skip_line();
  }

  void read_attribute(const std::string& keyword) {
    struct Attribute {
      std::string_view keyword;
      std::uint64_t components;
    };
    constexpr Attribute kAttributes[] = {{"vectors", 3}, {"normals", 3}, {"tensors", 9}, {"tensors6", 6}};
    if (keyword == "scalars") return read_scalars();
    const std::string name(text_.word("a name"));
    if (keyword == "lookup_table") {
      const std::uint64_t size = text_.count("the size of the table", 1);
      return static_cast<void>(values<double>(binary_ ? VtkType::uint8 : VtkType::float32, 4 * size));
    }
    if (keyword == "color_scalars") {
      const std::uint64_t components = text_.count("the number of components", 1);
      return skip_array(name, binary_ ? VtkType::uint8 : VtkType::float32, components * tuples_);
    }
    if (keyword == "texture_coordinates") {
      const std::uint64_t components = text_.count("the number of components", 1);
      return skip_array(name, type_of(text_, text_.word("a type")), components * tuples_);
    }
    for (const Attribute& attribute : kAttributes)
      if (attribute.keyword == keyword)
        return skip_array(name, type_of(text_, text_.word("a type")), attribute.components * tuples_);
    if (keyword == "pedigree_ids" && skip_strings_or_bits(name, tuples_)) return;
    if (keyword == "global_ids" || keyword == "pedigree_ids")
      return skip_array(name, type_of(text_, text_.word("a type")), tuples_);
    text_.fail("unknown keyword " + in_quotes(keyword));
  }

  void read_scalars() {
    const std::string name(text_.word("a name"));
    const VtkType type = type_of(text_, text_.word("a type"));
    const std::uint64_t components = text_.at_line_end() ? 1 : text_.count("the number of components", 1);
    const std::size_t start = text_.position();
    text_.skip_line();
    if (lower(text_.word("LOOKUP_TABLE")) == "lookup_table")
      static_cast<void>(text_.word_on_line());
    else
      text_.seek(start);  // old files omit the line
    read_array(name, type, components * tuples_);
  }

  TextReader text_;
  bool binary_ = false, has_points_ = false;
  bool of_cells_ = false, of_points_ = false;  ///< where the current attributes belong
  std::uint64_t tuples_ = 0;                   ///< of the current attributes
  VtkGrid grid_;
  std::map<std::string, std::vector<int>> other_ids_;  ///< arrays in which other programs store ids
  std::set<std::string> taken_;                        ///< those of them that are used
  VtkNames names_;
  std::array<VtkGrid, 4> parts_;  ///< cells of polygonal data: vertices, lines, polygons, strips
};

}  // namespace

MeshData read_vtk(const Source& source) {
  MeshData mesh = VtkReader(source).read();
  turn_to_vtk(mesh);
  return mesh;
}

}  // namespace holdfast::io
