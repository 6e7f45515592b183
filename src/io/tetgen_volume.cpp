// TetGen's volumes: .node, .ele, .face and .edge side by side (manual, section 5.2).
#include <limits>
#include <system_error>

#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/mid_nodes.h"
#include "io/tetgen.h"

namespace holdfast::io {
namespace {

std::filesystem::path with_extension(std::filesystem::path path, const char* extension) {
  return path.replace_extension(extension);
}

/// Reads the lines "number node... tag..." of one of the files, after its header; the tag is the first number
/// after the nodes, or 0. Returns how many lines have further attributes.
template <std::size_t N, typename Add>
std::size_t read_lines(TextReader& text, const char* what, const TetgenNodes& nodes, std::size_t count,
                       std::int64_t attributes, Add&& add) {
  std::int64_t first = nodes.base;
  for (std::size_t i = 0; i < count; ++i) {
    if (i == 0) {
      first = text.integer(what);
      if (first < 0 || first > std::numeric_limits<Index>::max())
        text.fail(std::string(what) + " is negative or beyond 32 bits: " + std::to_string(first));
    } else {
      read_tetgen_number(text, what, first + static_cast<std::int64_t>(i));
    }
    std::array<Index, N> corners{};  // and nodes on edges
    for (Index& corner : corners) corner = text.index("a vertex index", nodes.base, nodes.vertices.size());
    // Regions are attributes, which TetGen writes as reals.
    add(corners, text.at_line_end() ? 0 : text.tag_from_real("a marker"));
    text.skip_line();
  }
  return attributes > 1 ? count : 0;
}

/// Reads an optional file.
template <std::size_t N, typename Add>
void read_optional(const std::filesystem::path& path, Watch* watch, const char* what,
                   const TetgenNodes& nodes, Add&& add) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return;
  const FileBytes bytes(path, watch);
  TextReader text({path, bytes.view(), false, watch});
  const std::size_t count = text.count("the number of elements", 2 * N + 2);
  text.skip_line();
  static_cast<void>(read_lines<N>(text, what, nodes, count, 1, add));
}

/// Writes entities with the nodes on their edges, if any, after the corners.
template <std::size_t N, std::size_t M>
void write_lines(AtomicWriter& out, std::string_view columns,
                 const std::vector<std::array<Index, N>>& entities,
                 const std::vector<std::array<Index, M>>& nodes, const std::vector<int>& tags) {
  out << std::uint64_t{entities.size()} << columns << '\n';
  for (std::size_t i = 0; i < entities.size(); ++i) {
    out << std::uint64_t{i};
    for (const Index corner : entities[i]) out << ' ' << corner;
    if (!nodes.empty())
      for (const Index node : nodes[i]) out << ' ' << node;
    out << ' ' << tag_of(tags, i) << '\n';
  }
}

}  // namespace

MeshData read_tetgen_volume(const Source& source) {
  const std::filesystem::path elements = sibling(source.path, ".ele");
  TetgenNodes nodes = read_tetgen_node_file(source);
  const FileBytes bytes(elements, source.watch);
  TextReader text({elements, bytes.view(), false, source.watch});
  MeshData mesh;
  const std::size_t count = text.count("the number of elements", 10);
  const std::int64_t corners = text.at_line_end() ? 4 : text.integer("the number of corners");
  if (corners == 3)
    text.fail("elements of 3 nodes are triangles, as `plane` writes them; its .vtu is read, for example");
  if (corners != 4 && corners != 10) text.fail("tetrahedra of other than 4 or 10 nodes are not read");
  const std::int64_t attributes = text.at_line_end() ? 1 : text.integer("the number of attributes");
  text.skip_line();
  const char* const number = "the tetrahedron's number";
  const bool second = corners == 10;
  const auto add_tet = [&](const Tetrahedron& t, int region) { mesh.add_tetrahedron(t, region); };
  // TetGen orders the nodes by the edges 23 03 01 12 13 02.
  const auto add_tet10 = [&](const std::array<Index, 10>& n, int region) {
    add_second_order(mesh, Tetrahedron{n[0], n[1], n[2], n[3]}, {n[6], n[7], n[9], n[5], n[8], n[4]}, region);
  };
  const std::size_t more = second ? read_lines<10>(text, number, nodes, count, attributes, add_tet10)
                                  : read_lines<4>(text, number, nodes, count, attributes, add_tet);
  mesh.leave_out(more, "attributes of tetrahedra after the first",
                 "attribute of a tetrahedron after the first");
  const auto face = sibling(source.path, ".face"), edge = sibling(source.path, ".edge");
  const char* const face_number = "the face's number";
  const char* const edge_number = "the edge's number";
  if (second) {
    read_optional<6>(face, source.watch, face_number, nodes, [&](const std::array<Index, 6>& n, int marker) {
      add_second_order(mesh, Triangle{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, marker);
    });
    read_optional<3>(edge, source.watch, edge_number, nodes, [&](const std::array<Index, 3>& n, int marker) {
      add_second_order(mesh, Segment{n[0], n[1]}, n[2], marker);
    });
  } else {
    read_optional<3>(face, source.watch, face_number, nodes,
                     [&](const Triangle& t, int marker) { mesh.add_facet(t, marker); });
    read_optional<2>(edge, source.watch, edge_number, nodes,
                     [&](const Segment& s, int marker) { mesh.add_segment(s, marker); });
  }
  take_nodes(mesh, nodes);
  return mesh;
}

// Nodes on edges are in TetGen's order: after the corners, for a tetrahedron by the edges 23 03 01 12 13 02.
void write_tetgen(const std::filesystem::path& path, const Volume& volume, Watch* watch) {
  AtomicWriter node(with_extension(path, ".node"), watch), ele(with_extension(path, ".ele"), watch),
      face(with_extension(path, ".face"), watch), edge(with_extension(path, ".edge"), watch);
  const bool marked = !volume.vertex_markers.empty();
  const MidNodes& mid = volume.mid_nodes;
  node << std::uint64_t{volume.vertices.size() + mid.points.size()} << (marked ? " 3 0 1\n" : " 3 0 0\n");
  for (std::size_t i = 0; i < volume.vertices.size(); ++i) {
    const Point& p = volume.vertices[i];
    node << std::uint64_t{i} << ' ' << p[0] << ' ' << p[1] << ' ' << p[2];
    if (marked) node << ' ' << volume.vertex_markers[i];
    node << '\n';
  }
  for (std::size_t i = 0; i < mid.points.size(); ++i) {
    const Point& p = mid.points[i];
    node << std::uint64_t{volume.vertices.size() + i} << ' ' << p[0] << ' ' << p[1] << ' ' << p[2]
         << (marked ? " 0\n" : "\n");
  }
  std::vector<std::array<Index, 6>> of_tets;
  for (const auto& [ab, bc, ac, ad, bd, cd] : mid.tetrahedra) of_tets.push_back({cd, ad, ab, bc, bd, ac});
  std::vector<std::array<Index, 1>> of_segments;
  for (const Index n : mid.segments) of_segments.push_back({n});
  write_lines(ele, mid.empty() ? " 4 1" : " 10 1", volume.tetrahedra, of_tets, volume.regions);
  write_lines(face, " 1", volume.facets, mid.facets, volume.facet_markers);
  write_lines(edge, " 1", volume.segments, of_segments, volume.segment_markers);
  // All files are completed before any gets its name, so that a full disk does not mix old and new ones.
  for (AtomicWriter* file : {&node, &ele, &face, &edge}) file->finish();
  for (AtomicWriter* file : {&node, &ele, &face, &edge}) file->commit();
}

}  // namespace holdfast::io
