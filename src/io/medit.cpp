// Medit's .mesh, the ASCII form of GMF (Frey, Medit: an interactive mesh visualization software,
// INRIA RT-0253, 2001).
#include "io/cells.h"
#include "io/formats.h"
#include "io/mid_nodes.h"
#include "io/polygon.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

/// Reads `count` entities of N vertices and a reference each.
template <std::size_t N, typename Add>
void read_entities(TextReader& text, const char* what, std::size_t vertices, Add&& add) {
  const std::size_t count = text.count(what, 2 * N + 2);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<Index, N> corners{};
    for (Index& corner : corners) corner = text.index("a vertex index", 1, vertices);
    add(corners, text.tag("a reference"));
  }
}

template <std::size_t N>
void read_cells(TextReader& text, const char* what, std::size_t vertices, MeshData& mesh) {
  read_entities<N>(text, what, vertices,
                   [&](const std::array<Index, N>& corners, int tag) { add_cell(mesh, corners, N, tag); });
}

void read_vertices(TextReader& text, bool plane, MeshData& mesh) {
  if (!mesh.vertices.empty()) text.fail("a second section of vertices");
  const std::size_t count = text.count("the number of vertices", plane ? 6 : 8);
  mesh.vertices.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Point point{};
    for (std::size_t axis = 0; axis < (plane ? 2u : 3u); ++axis) point[axis] = text.real("a coordinate");
    mesh.add_vertex(point, text.tag_from_real("a reference"));  // some programs write "1.0"
  }
}

/// Skips an unused section: everything up to the next keyword.
void skip_section(TextReader& text, const std::string& keyword, MeshData& mesh) {
  mesh.remarks.push_back({RemarkKind::left_out, 1, "the section " + in_quotes(keyword) + " is left out"});
  while (!text.at_end()) {
    const std::size_t start = text.position();
    const std::string word = lower(text.word("a number"));
    const bool number = word.find_first_of("0123456789") == 0 || word.find_first_of("+-.") == 0 ||
                        word == "nan" || word == "inf" || word == "infinity";
    if (number) continue;
    text.seek(start);
    return;
  }
}

/// Refuses elements that cannot become facets or tetrahedra.
void refuse_elements(TextReader& text, const std::string& keyword) {
  if (text.count("the number of elements", 2) == 0) return;
  text.fail("the section " + in_quotes(keyword) +
            " is not read; split its elements into triangles or tetrahedra");
}

/// Reads the section of a lower-case keyword; returns whether it was the last. `plane` is set from the
/// dimension.
bool read_section(TextReader& text, const std::string& keyword, bool& plane, MeshData& mesh) {
  const std::size_t vertices = mesh.vertices.size();
  if (keyword == "end") return true;
  if (keyword == "meshversionformatted") {
    static_cast<void>(text.integer("the version"));
  } else if (keyword == "dimension") {
    const std::int64_t dimension = text.integer("the dimension");
    if (dimension != 2 && dimension != 3) text.fail("the dimension is neither 3 nor 2");
    plane = dimension == 2;  // z is 0
  } else if (keyword == "vertices") {
    read_vertices(text, plane, mesh);
  } else if (keyword == "triangles") {
    read_entities<3>(text, "the number of triangles", vertices,
                     [&](const Triangle& corners, int tag) { mesh.add_facet(corners, tag); });
  } else if (keyword == "edges") {
    read_entities<2>(text, "the number of edges", vertices,
                     [&](const Segment& corners, int tag) { mesh.add_segment(corners, tag); });
  } else if (keyword == "tetrahedra") {
    read_entities<4>(text, "the number of tetrahedra", vertices,
                     [&](const Tetrahedron& corners, int tag) { mesh.add_tetrahedron(corners, tag); });
  } else if (keyword == "trianglesp2") {
    read_entities<6>(text, "the number of triangles", vertices, [&](const std::array<Index, 6>& n, int tag) {
      add_second_order(mesh, Triangle{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, tag);
    });
  } else if (keyword == "edgesp2") {
    read_entities<3>(text, "the number of edges", vertices, [&](const std::array<Index, 3>& n, int tag) {
      add_second_order(mesh, Segment{n[0], n[1]}, n[2], tag);
    });
  } else if (keyword == "tetrahedrap2") {
    read_entities<
        10>(text, "the number of tetrahedra", vertices, [&](const std::array<Index, 10>& n, int tag) {
      add_second_order(mesh, Tetrahedron{n[0], n[1], n[2], n[3]}, {n[4], n[5], n[6], n[7], n[8], n[9]}, tag);
    });
  } else if (keyword == "quadrilaterals") {
    read_entities<4>(text, "the number of quadrilaterals", vertices,
                     [&](const std::array<Index, 4>& corners, int tag) {
                       add_polygon(mesh, corners, tag, [&](const std::string& reason) { text.fail(reason); });
                     });
  } else if (keyword == "hexahedra" || keyword == "hexaedra") {
    read_cells<8>(text, "the number of hexahedra", vertices, mesh);
  } else if (keyword == "prisms") {
    read_cells<6>(text, "the number of prisms", vertices, mesh);
  } else if (keyword == "pyramids") {
    read_cells<5>(text, "the number of pyramids", vertices, mesh);
  } else if (keyword.ends_with("p2") || keyword.ends_with("q2")) {
    refuse_elements(text, keyword);
  } else {
    skip_section(text, keyword, mesh);
  }
  return false;
}

}  // namespace

MeshData read_medit(const Source& source) {
  TextReader text(source);
  if (lower(text.word("MeshVersionFormatted")) != "meshversionformatted")
    text.fail("not a Medit mesh: it does not start with MeshVersionFormatted");
  static_cast<void>(text.integer("the version"));
  MeshData mesh(source);
  bool plane = false;
  // Some programs omit End. A section knows its length, so only whole sections can be missing.
  while (!text.at_end() || mesh.vertices.empty()) {
    const std::string keyword = lower(text.word("a keyword or End"));
    if (keyword.empty() || keyword[0] < 'a' || keyword[0] > 'z')
      text.fail("expected a keyword, found " + in_quotes(keyword));
    if (read_section(text, keyword, plane, mesh)) return mesh;
  }
  mesh.remarks.push_back(
      {RemarkKind::left_out, 1, "the file ends without 'End'; if it was cut off, sections are missing"});
  return mesh;
}

namespace {

/// With `nodes_of(i)` after the corners, in a section of second order, if `second_order`. The order of nodes
/// on edges is ours, 01 12 02 03 13 23.
template <std::size_t N, typename NodesOf>
void write_entities(AtomicWriter& out, const std::string& keyword, bool second_order,
                    const std::vector<std::array<Index, N>>& entities, const std::vector<int>& tags,
                    NodesOf&& nodes_of) {
  if (entities.empty()) return;
  out << '\n' << keyword << (second_order ? "P2\n" : "\n") << std::uint64_t{entities.size()} << '\n';
  for (std::size_t i = 0; i < entities.size(); ++i) {
    for (const Index corner : entities[i]) out << std::uint64_t{corner} + 1 << ' ';
    if (second_order)
      for (const Index node : nodes_of(i)) out << std::uint64_t{node} + 1 << ' ';
    out << tag_of(tags, i) << '\n';
  }
}

}  // namespace

void write_medit(AtomicWriter& out, const Volume& volume) {
  out << "MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n"
      << std::uint64_t{volume.vertices.size() + volume.mid_nodes.points.size()} << '\n';
  for (std::size_t i = 0; i < volume.vertices.size(); ++i) {
    const Point& p = volume.vertices[i];
    out << p[0] << ' ' << p[1] << ' ' << p[2] << ' ' << tag_of(volume.vertex_markers, i) << '\n';
  }
  const MidNodes& mid = volume.mid_nodes;
  for (const Point& p : mid.points) out << p[0] << ' ' << p[1] << ' ' << p[2] << " 0\n";
  const bool second = !mid.empty();
  write_entities(out, "Edges", second, volume.segments, volume.segment_markers,
                 [&](std::size_t i) { return std::array<Index, 1>{mid.segments[i]}; });
  write_entities(out, "Triangles", second, volume.facets, volume.facet_markers,
                 [&](std::size_t i) { return mid.facets[i]; });
  write_entities(out, "Tetrahedra", second, volume.tetrahedra, volume.regions,
                 [&](std::size_t i) { return mid.tetrahedra[i]; });
  out << "\nEnd\n";
}

}  // namespace holdfast::io
