// TetGen's surfaces, .poly and .smesh, and bare points, .node (Si, TetGen, a Delaunay-based quality
// tetrahedral mesh generator, ACM TOMS 41(2), 2015; manual, section 5.2).
//
// A polygon of two corners is a segment, one of a single corner a vertex; one of more than three is cut into
// triangles. A facet of several polygons, or with holes, is what they enclose together.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "holdfast/regular_tetrahedron.h"
#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/polygon.h"
#include "io/tetgen.h"

namespace holdfast::io {
namespace {

/// By Newton's method, whose arithmetic is the same everywhere, unlike std::cbrt.
double cube_root(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  const int thirds = exponent >= 0 ? (exponent + 2) / 3 : exponent / 3;
  m = std::ldexp(m, exponent - 3 * thirds);  // 1/8 <= m < 1
  double root = 1;
  for (int i = 0; i < 12; ++i) root = (2 * root + m / (root * root)) / 3;
  return std::ldexp(root, thirds);
}

class PolyReader {
 public:
  PolyReader(const Source& source, bool smesh) : text_(source), smesh_(smesh), mesh_(source) {}

  MeshData read() {
    TetgenNodes nodes = read_tetgen_nodes(text_);
    if (nodes.vertices.empty()) nodes = read_tetgen_node_file(text_.source());
    base_ = nodes.base;
    take_nodes(mesh_, nodes);
    read_facets();
    read_holes();
    read_regions();
    if (!text_.at_end()) {
      text_.seek(text_.position());
      text_.fail("text after the last section; the counts are wrong");
    }
    return std::move(mesh_);
  }

 private:
  int optional_tag() { return text_.at_line_end() ? 0 : text_.tag("a boundary marker"); }

  void read_facets() {
    const std::size_t count = text_.count("the number of facets", 2);
    // The line announces markers, but a marker at the end of a line is unambiguous anyway.
    text_.skip_line();
    mesh_.facets.reserve(count);
    for (std::size_t i = 0; i < count; ++i) smesh_ ? read_smesh_facet() : read_poly_facet();
  }

  void read_smesh_facet() {
    read_corners();
    const std::size_t start = text_.last();
    add(optional_tag(), start);
    text_.skip_line();
  }

  void read_poly_facet() {
    const std::size_t polygons = text_.count("the number of polygons", 2);
    const std::size_t start = text_.last();
    const std::int64_t holes = text_.at_line_end() ? 0 : text_.integer("the number of holes");
    if (holes < 0) text_.fail_at(start, "a negative number of holes");
    const int marker = optional_tag();
    text_.skip_line();
    plane::PolygonFacet facet;
    std::vector<std::size_t> positions;
    for (std::size_t i = 0; i < polygons; ++i) {
      read_corners();
      positions.push_back(text_.last());
      facet.polygons.push_back(corners_);
      text_.skip_line();
    }
    for (std::int64_t i = 0; i < holes; ++i) {
      static_cast<void>(text_.integer("the hole's number"));
      facet.holes.push_back(text_.point());
      text_.skip_line();
    }
    if (mesh_.keeps_polygons)
      mesh_.polygons.push_back(std::move(facet));
    else if (!add_together(facet, marker, start))
      add_apart(facet, marker, positions);
  }

  /// Adds what the polygons of a facet enclose together, and its segments. Returns false for polygons to be
  /// taken separately: a single one, or polygons that are not coplanar or cross, which `diagnose` reports.
  bool add_together(const plane::PolygonFacet& facet, int marker, std::size_t start) {
    const auto is_area = [](const std::vector<Index>& polygon) { return polygon.size() >= 3; };
    const bool area = std::any_of(facet.polygons.begin(), facet.polygons.end(), is_area);
    if (facet.holes.empty() && (facet.polygons.size() < 2 || !area)) return false;
    if (!area) text_.fail_at(start, "a facet with holes and without a polygon of three corners or more");
    const plane::CutFacet cut =
        plane::cut_facet(mesh_.vertices, facet, mesh_.tolerance, poll_of(mesh_.watch));
    if (!cut.reason.empty()) {
      if (facet.holes.empty()) return false;
      text_.fail_at(start, "a facet with holes " + cut.reason);
    }
    mesh_.add_cut(cut.triangles, cut.deviation, marker);
    for (const std::vector<Index>& polygon : facet.polygons)
      if (polygon.size() == 2) mesh_.add_segment({polygon[0], polygon[1]}, marker);
    return true;
  }

  void add_apart(const plane::PolygonFacet& facet, int marker, const std::vector<std::size_t>& positions) {
    for (std::size_t i = 0; i < facet.polygons.size(); ++i) {
      corners_ = facet.polygons[i];
      add(marker, positions[i]);
    }
  }

  /// Reads "size corner...", which may continue in the next line.
  void read_corners() {
    corners_.resize(text_.count("the number of corners", 2));
    for (Index& corner : corners_) corner = text_.index("a vertex index", base_, mesh_.vertices.size());
  }

  void add(int marker, std::size_t position) {
    add_polygon(mesh_, corners_, marker, [&](const std::string& reason) { text_.fail_at(position, reason); });
  }

  void read_holes() {
    if (text_.at_end()) return;  // the section may be missing
    const std::size_t count = text_.count("the number of holes", 8);
    text_.skip_line();
    for (std::size_t i = 0; i < count; ++i) {
      static_cast<void>(text_.integer("the hole's number"));
      mesh_.holes.push_back(text_.point());
      text_.skip_line();
    }
  }

  void read_regions() {
    if (text_.at_end()) return;
    const std::size_t count = text_.count("the number of regions", 10);
    text_.skip_line();
    for (std::size_t i = 0; i < count; ++i) {
      static_cast<void>(text_.integer("the region's number"));
      const Point where = text_.point();
      const int id = text_.tag_from_real("a region's attribute");
      mesh_.region_seeds.push_back({where, id, text_.at_line_end() ? 0 : read_size()});
      text_.skip_line();
    }
    const auto limits = static_cast<std::size_t>(
        std::count_if(mesh_.region_seeds.begin(), mesh_.region_seeds.end(),
                      [](const Surface::RegionSeed& seed) { return seed.size > 0; }));
    if (limits > 0)
      mesh_.remarks.push_back(
          {RemarkKind::size_limits, limits,
           std::to_string(limits) + (limits == 1 ? " region's limit V" : " regions' limits V") +
               " on the volume of tetrahedra " + (limits == 1 ? "is taken as a size" : "are taken as sizes") +
               " H = (6 sqrt(2) V)^(1/3)"});
  }

  /// The edge of the regular tetrahedron with the largest volume allowed in a region; 0 for no limit.
  double read_size() {
    const double volume = text_.real("a region's largest volume");
    if (!std::isfinite(volume)) text_.fail("a region's largest volume is not finite");
    return volume > 0 ? regular_edge_of_volume_one * cube_root(volume) : 0;
  }

  TextReader text_;
  bool smesh_;
  MeshData mesh_;
  std::int64_t base_ = 0;
  std::vector<Index> corners_;
};

/// Whether the .ele beside the file says that there are no tetrahedra: then .face and .edge are a surface, as
/// `convert` writes it. Otherwise they belong to a volume.
bool has_no_tetrahedra(const Source& source) {
  const std::filesystem::path elements = sibling(source.path, ".ele");
  std::error_code error;
  if (!std::filesystem::exists(elements, error)) return false;
  const FileBytes bytes(elements, source.watch);
  const std::string_view text = bytes.view();
  return text.substr(0, text.find_first_of(" \t\r\n")) == "0";
}

}  // namespace

TetgenNodes read_tetgen_nodes(TextReader& text) {
  TetgenNodes nodes;
  const std::size_t count = text.count("the number of vertices", 8);
  if (const std::int64_t dimension = text.at_line_end() ? 3 : text.integer("the dimension"); dimension != 3)
    text.fail("the dimension is " + std::to_string(dimension) + ", not 3" +
              (dimension == 2 ? "; `plane` reads files of two dimensions" : ""));
  const std::size_t attributes = text.at_line_end() ? 0 : text.count("the number of attributes", 1);
  const bool marked = !text.at_line_end() && text.integer("whether there are markers") != 0;
  nodes.attributes = attributes;
  text.skip_line();
  nodes.vertices.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t number = text.integer("the vertex's number");
    if (i == 0) nodes.base = number;
    if (nodes.base != 0 && nodes.base != 1) text.fail("the first vertex must have the number 0 or 1");
    if (number != nodes.base + static_cast<std::int64_t>(i))
      text.fail("expected vertex " + std::to_string(nodes.base + static_cast<std::int64_t>(i)) +
                ", found the number " + std::to_string(number));
    const Point point = text.point();
    for (std::size_t k = 0; k < attributes && !text.at_line_end(); ++k)
      static_cast<void>(text.real("an attribute"));
    nodes.markers.add(i, marked && !text.at_line_end() ? text.tag_from_real("a boundary marker") : 0);
    nodes.vertices.push_back(point);
    text.skip_line();
  }
  return nodes;
}

void take_nodes(MeshData& mesh, TetgenNodes& nodes) {
  mesh.leave_out(nodes.attributes * nodes.vertices.size(), "attributes of vertices", "attribute of a vertex");
  mesh.vertices = std::move(nodes.vertices);
  mesh.vertex_markers = std::move(nodes.markers);
}

TetgenNodes read_tetgen_node_file(const Source& source) {
  const std::filesystem::path beside = sibling(source.path, ".node");
  const FileBytes bytes(beside, source.watch);
  TextReader text({beside, bytes.view(), source.finite, source.watch});
  return read_tetgen_nodes(text);
}

void read_tetgen_number(TextReader& text, const char* what, std::int64_t expected) {
  if (text.integer(what) != expected)
    text.fail("expected " + std::string(what) + " " + std::to_string(expected));
}

MeshData read_poly(const Source& source) { return PolyReader(source, false).read(); }

MeshData read_smesh(const Source& source) { return PolyReader(source, true).read(); }

MeshData read_node(const Source& source) {
  if (has_no_tetrahedra(source)) return read_tetgen_volume(source);
  TextReader text(source);
  MeshData mesh;
  TetgenNodes nodes = read_tetgen_nodes(text);
  take_nodes(mesh, nodes);
  return mesh;
}

}  // namespace holdfast::io
