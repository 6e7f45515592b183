// OFF, text and binary (Geomview's object file format, http://www.geomview.org/docs/html/OFF.html).
//
// A "face" of two corners is a segment and one of a single corner an isolated vertex, as in the surfaces of
// Holdfast's corpus. What follows the coordinates or corners (normals, colours, texture coordinates) is
// skipped. Each line has one vertex or face; a file for which this is not true is read as numbers on any
// lines, with nothing after the corners.
#include <exception>
#include <optional>

#include "io/byte_reader.h"
#include "io/formats.h"
#include "io/polygon.h"
#include "io/text_reader.h"
#include "text/count.h"

namespace holdfast::io {
namespace {

struct Header {
  bool binary = false;
  std::size_t floats_behind = 0;  ///< numbers after the coordinates of a vertex
};

/// Skips what may precede the header: "appearance" with display settings in braces.
bool skip_appearance(TextReader& text) {
  const std::size_t start = text.position();
  constexpr std::string_view kKeyword = "appearance";
  if (text.at_end() || lower(text.remaining().substr(0, kKeyword.size())) != kKeyword) {
    text.seek(start);
    return false;
  }
  text.seek(text.position() + kKeyword.size());
  const std::size_t word = text.position();
  if (text.at_end() || text.remaining()[0] != '{') {
    text.seek(word);
    text.fail("expected an opening brace, found " + in_quotes(text.word("an opening brace")));
  }
  for (int depth = 0; !text.at_end();) {
    const char c = text.remaining()[0];
    text.seek(text.position() + 1);
    depth += c == '{' ? 1 : c == '}' ? -1 : 0;
    if (depth == 0) return true;
  }
  text.fail_at(start, "the appearance has no closing brace");
}

/// Reads "[ST][C][N][4][n]OFF [BINARY]", which may be missing; requires three dimensions.
Header read_header(TextReader& text) {
  Header header;
  const bool number = text.number_follows();
  const std::size_t start = text.position();
  std::string_view word = text.word("the keyword OFF");
  // Unlike N for normals, n announces the number of dimensions.
  const bool tells_dimensions = word.ends_with("nOFF");
  const std::string keyword = lower(word);
  if (!keyword.ends_with("off")) {
    if (!number) text.fail("not an OFF file: it starts with " + in_quotes(keyword));
    text.seek(start);
    return header;
  }
  struct Part {
    std::string_view name;
    std::size_t floats;
  };
  std::string_view prefix = std::string_view(keyword).substr(0, keyword.size() - (tells_dimensions ? 4 : 3));
  for (const Part& part : {Part{"st", 2}, Part{"c", 4}, Part{"n", 3}}) {
    if (!prefix.starts_with(part.name)) continue;
    prefix.remove_prefix(part.name.size());
    header.floats_behind += part.floats;
  }
  if (!prefix.empty()) text.fail(in_quotes(word) + " is not OFF of three dimensions");
  if (tells_dimensions && text.integer("the number of dimensions") != 3)
    text.fail("only OFF of three dimensions is read");
  if (text.at_line_end() || text.number_follows()) return header;
  header.binary = lower(text.word_on_line()) == "binary";
  if (!header.binary) text.fail("expected the number of vertices");
  return header;
}

class OffReader {
 public:
  explicit OffReader(const Source& source) : source_(source), text_(source), mesh_(source) {}

  MeshData read() {
    mesh_.leave_out(skip_appearance(text_) ? 1 : 0, "appearances", "appearance");
    const Header header = read_header(text_);
    header.binary ? read_bytes(header) : read_text(header);
    mesh_.leave_out(decorated_, "vertices' and faces' normals, colours or texture coordinates",
                    "vertex's or face's normal, colour or texture coordinates");
    return std::move(mesh_);
  }

 private:
  void read_text(const Header& header) {
    const std::size_t start = text_.position();
    const MeshData before = mesh_;
    try {
      read_numbers();
    } catch (const FileError&) {
      const std::exception_ptr error = std::current_exception();
      text_.seek(start);
      mesh_ = before;
      decorated_ = 0;
      behind_vertex_ = header.floats_behind;
      try {
        read_numbers();
      } catch (const FileError&) {
        std::rethrow_exception(error);
      }
    }
  }

  void read_numbers() {
    const std::size_t vertices = text_.count("the number of vertices", 6);
    const std::size_t faces = text_.count("the number of faces", 2);
    // The number of edges is unreliable.
    if (!behind_vertex_)
      text_.skip_line();
    else if (!text_.at_line_end())
      static_cast<void>(text_.integer("the number of edges"));
    mesh_.vertices.reserve(vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
      mesh_.vertices.push_back(text_.point());
      end_line(behind_vertex_.value_or(0));
    }
    mesh_.facets.reserve(faces);
    for (std::size_t i = 0; i < faces; ++i) {
      corners_.resize(text_.count("the number of corners", 2));
      const std::size_t start = text_.last();
      for (Index& corner : corners_) corner = text_.index("a vertex index", 0, mesh_.vertices.size());
      add_polygon(mesh_, corners_, 0, [&](const std::string& reason) { text_.fail_at(start, reason); });
      end_line(0);
    }
    if (!text_.at_end()) {
      text_.seek(text_.position());
      text_.fail("text after the last of " + counted(faces, "face") + "; the counts are wrong");
    }
  }

  void end_line(std::size_t numbers_behind) {
    if (behind_vertex_) {
      decorated_ += numbers_behind > 0 ? 1 : 0;
      for (; numbers_behind > 0; --numbers_behind) static_cast<void>(text_.real("a number behind a vertex"));
      return;
    }
    decorated_ += text_.at_line_end() ? 0 : 1;
    text_.skip_line();
  }

  /// OpenMesh writes numbers little-endian, and faces without a colour's count. Such counts of vertices and
  /// faces are nonsense when read big-endian.
  [[nodiscard]] bool is_of_openmesh() const {
    const auto fits = [&](std::endian order) {
      ByteReader bytes(source_, order, text_.position());
      if (bytes.left() < 12) return false;
      const std::uint64_t vertices = bytes.read<std::uint32_t>(), faces = bytes.read<std::uint32_t>();
      static_cast<void>(bytes.read<std::uint32_t>());
      return 12 * vertices + 8 * faces <= bytes.left();
    };
    return !fits(std::endian::big) && fits(std::endian::little);
  }

  /// Reads 32-bit numbers after the header's line, big-endian if the file follows the format; then the colour
  /// of a face has its count first.
  void read_bytes(const Header& header) {
    text_.skip_line();
    has_colour_counts_ = !is_of_openmesh();
    ByteReader bytes(source_, has_colour_counts_ ? std::endian::big : std::endian::little, text_.position());
    const auto vertices = bytes.read<std::uint32_t>(), faces = bytes.read<std::uint32_t>();
    static_cast<void>(bytes.read<std::uint32_t>());  // the number of edges
    bytes.require_items(vertices, 4 * (3 + header.floats_behind), "vertices");
    mesh_.vertices.reserve(vertices);
    for (std::uint32_t i = 0; i < vertices; ++i) {
      const double x = bytes.read<float>(), y = bytes.read<float>();
      mesh_.vertices.push_back({x, y, bytes.read<float>()});
      static_cast<void>(bytes.take(4 * header.floats_behind));
    }
    if (header.floats_behind > 0) decorated_ += vertices;
    bytes.require_items(faces, 8, "faces");
    mesh_.facets.reserve(faces);
    for (std::uint32_t i = 0; i < faces; ++i) read_face(bytes);
    if (bytes.left() > 0)
      bytes.fail("bytes after the last of " + counted(faces, "face") + "; the counts are wrong");
  }

  void read_face(ByteReader& bytes) {
    const auto size = bytes.read<std::uint32_t>();
    bytes.require_items(size, 4, "corners");
    corners_.resize(size);
    for (Index& corner : corners_) {
      corner = bytes.read<std::uint32_t>();
      if (corner >= mesh_.vertices.size())
        bytes.fail("the vertex index " + std::to_string(corner) + " is out of range; there are " +
                   std::to_string(mesh_.vertices.size()) + " vertices and the first is 0");
    }
    add_polygon(mesh_, corners_, 0, [&](const std::string& reason) { bytes.fail(reason); });
    if (!has_colour_counts_) return;
    const auto components = bytes.read<std::uint32_t>();
    if (components > 4)
      bytes.fail("a colour of " + std::to_string(components) + " components; there are 4 at most");
    static_cast<void>(bytes.take(std::size_t{4} * components));
    decorated_ += components > 0 ? 1 : 0;
  }

  Source source_;
  TextReader text_;
  MeshData mesh_;
  std::vector<Index> corners_;
  std::size_t decorated_ = 0;
  bool has_colour_counts_ = true;             ///< behind the faces of a binary file
  std::optional<std::size_t> behind_vertex_;  ///< numbers behind a vertex, where lines do not tell their end
};

}  // namespace

MeshData read_off(const Source& source) { return OffReader(source).read(); }

}  // namespace holdfast::io
