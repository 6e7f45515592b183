// PLY, ASCII and binary (Turk, The PLY polygon file format, 1994).
//
// Reads vertex {x, y, z}, face {vertex_indices or vertex_index} and edge {vertex1, vertex2}, each optionally
// with an integer "marker", tristrips {vertex_indices}, and names in comments. Other elements and properties
// are skipped.
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>

#include "io/byte_reader.h"
#include "io/formats.h"
#include "io/labels.h"
#include "io/polygon.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

// int64 and uint64 are no types of the format's first description, but meshio and others write them.
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

struct Property {
  std::string name;
  PlyType type{};
  std::optional<PlyType> count_type;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::size_t position = 0;  ///< in the header
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct PlyHeader {
  NamedIds facets{kFacetStem}, vertices{kVertexStem}, segments{kSegmentStem};  ///< named by comments
  bool binary = false;
  std::endian order = std::endian::little;
  std::vector<PlyElement> elements;
  std::vector<std::string> others;  ///< words of lines unknown to PLY
};

std::size_t size_of(PlyType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

PlyType read_type(TextReader& text) {
  struct Name {
    std::string_view name;
    PlyType type;
  };
  constexpr Name kNames[] = {
      {"char", PlyType::int8},       {"int8", PlyType::int8},      {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},     {"short", PlyType::int16},    {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},   {"uint16", PlyType::uint16},  {"int", PlyType::int32},
      {"int32", PlyType::int32},     {"uint", PlyType::uint32},    {"uint32", PlyType::uint32},
      {"int64", PlyType::int64},     {"uint64", PlyType::uint64},  {"float", PlyType::float32},
      {"float32", PlyType::float32}, {"double", PlyType::float64}, {"float64", PlyType::float64}};
  const std::string_view word = text.word_on_line();
  for (const Name& name : kNames)
    if (name.name == word) return name.type;
  text.fail("expected a type such as float or int, found " + in_quotes(word));
}

bool is_real(PlyType type) { return type == PlyType::float32 || type == PlyType::float64; }

void read_format(TextReader& text, PlyHeader& header) {
  const std::string_view format = text.word_on_line();
  header.binary = format != "ascii";
  if (format == "binary_big_endian")
    header.order = std::endian::big;
  else if (header.binary && format != "binary_little_endian")
    text.fail("unknown format " + in_quotes(format));
}

Property read_property(TextReader& text) {
  Property property;
  const std::size_t start = text.position();
  if (text.word_on_line() == "list") {
    property.count_type = read_type(text);
    if (is_real(*property.count_type)) text.fail("the length of a list must be an integer");
  } else {
    text.seek(start);
  }
  property.type = read_type(text);
  property.name = text.word_on_line();
  return property;
}

/// Reads the header and leaves `text` at the first byte of the data.
PlyHeader read_ply_header(TextReader& text) {
  if (text.word("ply") != "ply") text.fail("not a PLY file: it does not start with 'ply'");
  // The first line's ending shows whether data starts after "end_header\r" or "end_header\r
  // ".
  const bool crlf = text.remaining().starts_with("\r\n");
  PlyHeader header;
  bool has_format = false;
  for (;;) {
    const std::string_view keyword = text.word("'end_header'");
    if (keyword == "end_header") break;
    if (keyword == "format") {
      read_format(text, header);
      has_format = true;
    } else if (keyword == "element") {
      PlyElement element;
      element.position = text.last();
      element.name = text.word_on_line();
      element.count = text.count("the number of elements", 1);
      header.elements.push_back(element);
    } else if (keyword == "property") {
      if (header.elements.empty()) text.fail("a property without an element");
      header.elements.back().properties.push_back(read_property(text));
    } else if (keyword == "comment") {
      const std::string_view rest = text.remaining();
      read_id_comment(rest.substr(0, rest.find_first_of("\r\n")),
                      std::array{&header.facets, &header.vertices, &header.segments});
    } else if (header.elements.empty() && keyword != "obj_info") {
      // Blender 2.47 names the file's author there. After an element it could be a misspelt property.
      header.others.emplace_back(keyword);
    } else if (keyword != "obj_info") {
      text.fail("unknown keyword " + in_quotes(keyword) + " in the header");
    }
    text.skip_line();
  }
  if (!has_format) text.fail("the header names no format");
  static_cast<void>(text.at_line_end());
  if (!crlf && text.remaining().starts_with("\r"))
    text.seek(text.position() + 1);
  else
    text.skip_line();
  return header;
}

class TextValues {
 public:
  explicit TextValues(TextReader& text) : text_(text) {}
  double real(PlyType) { return text_.real("a number"); }
  std::int64_t integer(PlyType) { return text_.integer("an integer"); }
  void require(std::uint64_t count, std::size_t, const char* what) const {
    if (count > (text_.remaining().size() + 1) / 2)
      text_.fail(std::to_string(count) + " " + what + " are announced, but only " +
                 std::to_string(text_.remaining().size()) + " bytes follow");
  }
  [[noreturn]] void fail(const std::string& reason) const { text_.fail(reason); }
  void begin_entity() {}
  void require_end() const {
    if (text_.at_end()) return;
    text_.seek(text_.position());
    text_.fail("text after the last element; the counts are wrong");
  }

 private:
  TextReader& text_;
};

class BinaryValues {
 public:
  explicit BinaryValues(ByteReader bytes) : bytes_(bytes) {}
  double real(PlyType type) {
    if (type == PlyType::float32) return static_cast<double>(bytes_.read<float>());
    if (type == PlyType::float64) return bytes_.read<double>();
    return static_cast<double>(integer(type));
  }
  std::int64_t integer(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return bytes_.read<std::int8_t>();
      case PlyType::uint8:
        return bytes_.read<std::uint8_t>();
      case PlyType::int16:
        return bytes_.read<std::int16_t>();
      case PlyType::uint16:
        return bytes_.read<std::uint16_t>();
      case PlyType::int32:
        return bytes_.read<std::int32_t>();
      case PlyType::uint32:
        return bytes_.read<std::uint32_t>();
      case PlyType::int64:
        return bytes_.read<std::int64_t>();
      case PlyType::uint64:
        return static_cast<std::int64_t>(std::min<std::uint64_t>(bytes_.read<std::uint64_t>(), INT64_MAX));
      default:
        bytes_.fail("an index must be an integer, not a real");
    }
  }
  void require(std::uint64_t count, std::size_t bytes_each, const char* what) const {
    bytes_.require_items(count, bytes_each, what);
  }
  /// Fails with the byte position where the entity starts.
  [[noreturn]] void fail(const std::string& reason) {
    bytes_.seek(entity_);
    bytes_.fail(reason);
  }
  void begin_entity() { entity_ = bytes_.position(); }
  /// Some programs end the file with a line break, or pad it with zeros to a whole block.
  void require_end() const {
    ByteReader behind = bytes_;
    if (behind.take(behind.left()).find_first_not_of(std::string_view("\r\n\0", 3)) != std::string_view::npos)
      bytes_.fail("bytes after the last element; the counts are wrong");
  }

 private:
  ByteReader bytes_;
  std::size_t entity_ = 0;
};

template <typename Values>
class PlyReader {
 public:
  PlyReader(const TextReader& text, const PlyHeader& header, Values values)
      : text_(text), header_(header), values_(values), mesh_(text.source()) {}

  MeshData read() {
    for (const PlyElement& element : header_.elements) {
      if (element.count == 0 || element.properties.empty()) continue;
      values_.require(element.count, least_size(element), "elements");
      if (element.name != "vertex") require_vertices_before(element);
      if (element.name == "vertex")
        read_vertices(element);
      else if (element.name == "face")
        read_faces(element);
      else if (element.name == "edge")
        read_edges(element);
      else if (element.name == "tristrips")
        read_strips(element);
      else
        skip(element);
    }
    values_.require_end();
    tell_skipped();
    NamedIds facets = header_.facets, segments = header_.segments, vertices = header_.vertices;
    mesh_.names = {facets.take(), {}, segments.take(), vertices.take()};
    return std::move(mesh_);
  }

 private:
  /// Reports elements, and properties of elements read, that have no place in a mesh.
  void tell_skipped() {
    std::string words;
    for (const std::string& word : header_.others) words += (words.empty() ? "" : ", ") + in_quotes(word);
    mesh_.leave_out(header_.others.size(), "lines of the header that PLY does not have (" + words + ")",
                    "line of the header that PLY does not have (" + words + ")");
    constexpr std::string_view kRead[] = {"x",       "y",       "z",     "vertex_indices", "vertex_index",
                                          "vertex1", "vertex2", "marker"};
    for (const PlyElement& element : header_.elements) {
      if (element.count == 0) continue;
      const bool is_read = element.name == "vertex" || element.name == "face" || element.name == "edge" ||
                           element.name == "tristrips";
      std::string names;
      for (const Property& property : element.properties)
        if (std::find(std::begin(kRead), std::end(kRead), property.name) == std::end(kRead))
          names += (names.empty() ? "" : ", ") + property.name;
      if (!is_read)
        mesh_.leave_out(element.count, "elements " + in_quotes(element.name),
                        "element " + in_quotes(element.name));
      else if (!names.empty())
        mesh_.remarks.push_back(
            {RemarkKind::left_out, element.count, "of every " + element.name + " is left out: " + names});
    }
  }

  /// Elements that name vertices can only be checked after them.
  void require_vertices_before(const PlyElement& element) {
    const bool names_vertices =
        element.name == "face" || element.name == "edge" || element.name == "tristrips";
    if (!names_vertices || !mesh_.vertices.empty()) return;
    for (const PlyElement& other : header_.elements)
      if (other.name == "vertex" && other.position > element.position)
        text_.fail_at(element.position,
                      "the element " + in_quotes(element.name) +
                          " comes before the vertices, which is not supported: save vertices first");
  }

  static std::size_t least_size(const PlyElement& element) {
    std::size_t size = 0;
    for (const Property& property : element.properties)
      size += size_of(property.count_type.value_or(property.type));
    return size;
  }

  /// The position of the property with one of two names; throws if there is none.
  std::size_t find(const PlyElement& element, std::string_view name, std::string_view other = {}) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const Property& property = element.properties[i];
      if (property.name == name || (!other.empty() && property.name == other)) return i;
    }
    text_.fail_at(element.position,
                  "the element " + in_quotes(element.name) + " has no property " + in_quotes(name));
  }

  /// The position of the property "marker", if it exists and is an integer.
  static std::size_t find_marker(const PlyElement& element) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const Property& property = element.properties[i];
      if (property.name == "marker" && !property.count_type && !is_real(property.type)) return i;
    }
    return element.properties.size();
  }

  int marker(PlyType type) {
    const std::int64_t value = values_.integer(type);
    if (!std::in_range<int>(value)) values_.fail("a marker beyond 32 bits: " + std::to_string(value));
    return static_cast<int>(value);
  }

  std::size_t list_length(const Property& property) {
    const std::int64_t length = values_.integer(*property.count_type);
    if (length < 0) values_.fail("a list of negative length");
    values_.require(static_cast<std::uint64_t>(length), size_of(property.type), "list entries");
    return static_cast<std::size_t>(length);
  }

  void skip(const Property& property) {
    const std::size_t length = property.count_type ? list_length(property) : 1;
    for (std::size_t i = 0; i < length; ++i) static_cast<void>(values_.real(property.type));
  }

  void skip(const PlyElement& element) {
    for (std::size_t i = 0; i < element.count; ++i)
      for (const Property& property : element.properties) skip(property);
  }

  Index index(PlyType type) { return in_range(values_.integer(type)); }

  Index in_range(std::int64_t value) {
    if (value < 0 || static_cast<std::uint64_t>(value) >= mesh_.vertices.size())
      values_.fail("the vertex index " + std::to_string(value) + " is out of range; there are " +
                   std::to_string(mesh_.vertices.size()) + " vertices and the first is 0");
    return static_cast<Index>(value);
  }

  void read_vertices(const PlyElement& element) {
    const std::array<std::size_t, 3> axes{find(element, "x"), find(element, "y"), find(element, "z")};
    for (const std::size_t axis : axes)
      if (element.properties[axis].count_type) text_.fail_at(element.position, "a coordinate that is a list");
    const std::size_t mark = find_marker(element);
    mesh_.vertices.reserve(element.count);
    for (std::size_t i = 0; i < element.count; ++i) {
      values_.begin_entity();
      Point point{};
      int id = 0;
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const Property& property = element.properties[p];
        const auto axis = std::find(axes.begin(), axes.end(), p);
        if (p == mark)
          id = marker(property.type);
        else if (axis == axes.end())
          skip(property);
        else
          point[static_cast<std::size_t>(axis - axes.begin())] = values_.real(property.type);
      }
      mesh_.add_vertex(point, id);
    }
  }

  void read_faces(const PlyElement& element) {
    const std::size_t list = find(element, "vertex_indices", "vertex_index");
    if (!element.properties[list].count_type)
      text_.fail_at(element.position, "vertex indices that are no list");
    const std::size_t mark = find_marker(element);
    mesh_.facets.reserve(element.count);
    std::vector<Index> corners;
    for (std::size_t i = 0; i < element.count; ++i) {
      values_.begin_entity();
      int id = 0;
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const Property& property = element.properties[p];
        if (p == mark)
          id = marker(property.type);
        else if (p != list)
          skip(property);
        if (p != list) continue;
        corners.resize(list_length(property));
        for (Index& corner : corners) corner = index(property.type);
      }
      add_polygon(mesh_, corners, id, [&](const std::string& reason) { values_.fail(reason); });
    }
  }

  /// Each list contains strips, which end with negative numbers.
  void read_strips(const PlyElement& element) {
    const std::size_t list = find(element, "vertex_indices", "vertex_index");
    if (!element.properties[list].count_type)
      text_.fail_at(element.position, "vertex indices that are no list");
    std::vector<Index> corners;
    for (std::size_t i = 0; i < element.count; ++i) {
      values_.begin_entity();
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const Property& property = element.properties[p];
        if (p != list) {
          skip(property);
          continue;
        }
        corners.clear();
        for (std::size_t left = list_length(property); left > 0; --left) {
          const std::int64_t corner = values_.integer(property.type);
          if (corner >= 0) corners.push_back(in_range(corner));
          if (corner >= 0 && left > 1) continue;
          add_strip(mesh_, corners, 0);
          corners.clear();
        }
      }
    }
  }

  void read_edges(const PlyElement& element) {
    const std::array<std::size_t, 2> ends{find(element, "vertex1"), find(element, "vertex2")};
    const std::size_t mark = find_marker(element);
    for (std::size_t i = 0; i < element.count; ++i) {
      values_.begin_entity();
      Segment segment{};
      int id = 0;
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const auto end = std::find(ends.begin(), ends.end(), p);
        if (p == mark)
          id = marker(element.properties[p].type);
        else if (end == ends.end() || element.properties[p].count_type)
          skip(element.properties[p]);
        else
          segment[static_cast<std::size_t>(end - ends.begin())] = index(element.properties[p].type);
      }
      mesh_.add_segment(segment, id);
    }
  }

  const TextReader& text_;  ///< for errors in the header
  const PlyHeader& header_;
  Values values_;
  MeshData mesh_;
};

}  // namespace

MeshData read_ply(const Source& source) {
  TextReader text(source, '\0');
  const PlyHeader header = read_ply_header(text);
  if (!header.binary) return PlyReader(text, header, TextValues(text)).read();
  return PlyReader(text, header, BinaryValues(ByteReader(source, header.order, text.position()))).read();
}

}  // namespace holdfast::io
