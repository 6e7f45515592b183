// OFF (Geomview's object file format, http://www.geomview.org/docs/html/OFF.html).
//
// Here a "face" of two corners is a segment and one of a single corner an isolated vertex, as in the
// surfaces of Holdfast's corpus. What follows the coordinates or the corners on a line (normals,
// colours, texture coordinates) is skipped.
#include "io/formats.h"
#include "io/polygon.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

/// Reads "[ST][C][N][4][n]OFF", which may be missing, and refuses what is not three-dimensional text.
void read_header(TextReader& text) {
  const bool number = text.number_follows();
  const std::size_t start = text.position();
  const std::string keyword = lower(text.word("the keyword OFF"));
  if (!keyword.ends_with("off")) {
    if (!number) text.fail("not an OFF file: it starts with " + in_quotes(keyword));
    text.seek(start);
    return;
  }
  std::string_view prefix = std::string_view(keyword).substr(0, keyword.size() - 3);
  for (const char* part : {"st", "c", "n"})
    if (prefix.starts_with(part)) prefix.remove_prefix(std::string_view(part).size());
  if (!prefix.empty()) text.fail(in_quotes(keyword) + " is not OFF of three dimensions");
  if (text.at_line_end() || text.number_follows()) return;
  if (lower(text.word_on_line()) == "binary") text.fail("binary OFF is not read; save it as text");
  text.fail("expected the number of vertices");
}

void read_face(TextReader& text, MeshData& mesh, std::vector<Index>& corners) {
  const std::size_t size = text.count("the number of corners", 2);
  const std::size_t start = text.last();
  corners.clear();
  for (std::size_t i = 0; i < size; ++i)
    corners.push_back(text.index("a vertex index", 0, mesh.vertices.size()));
  add_polygon(mesh, corners, 0, [&](const std::string& reason) { text.fail_at(start, reason); });
  text.skip_line();
}

}  // namespace

MeshData read_off(const Source& source) {
  TextReader text(source);
  read_header(text);
  const std::size_t vertices = text.count("the number of vertices", 6);
  const std::size_t faces = text.count("the number of faces", 2);
  text.skip_line();  // the number of edges, which nobody maintains
  MeshData mesh;
  mesh.vertices.reserve(vertices);
  for (std::size_t i = 0; i < vertices; ++i) {
    mesh.vertices.push_back(text.point());
    text.skip_line();
  }
  mesh.facets.reserve(faces);
  std::vector<Index> corners;
  for (std::size_t i = 0; i < faces; ++i) read_face(text, mesh, corners);
  if (!text.at_end()) {
    text.seek(text.position());
    text.fail("text after the last of " + std::to_string(faces) + " faces; the counts are wrong");
  }
  return mesh;
}

}  // namespace holdfast::io
