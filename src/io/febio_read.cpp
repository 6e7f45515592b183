// Reads the mesh of FEBio's models, .feb, of versions 1.2 to 4 (FEBio user's manual, "Mesh section" and
// "Geometry section"): parts of elements are regions and markers, surfaces markers, edges segments; node sets
// mark vertices.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>

#include "io/cells.h"
#include "io/file_sets.h"
#include "io/formats.h"
#include "io/labels.h"
#include "io/mid_nodes.h"
#include "io/numbered.h"
#include "io/polygon.h"
#include "io/text_reader.h"
#include "io/xml_reader.h"
#include "text/parse.h"

namespace holdfast::io {
namespace {

constexpr std::size_t kFebioMostNodes = 27;  // of an element

struct FebShape {
  std::string_view name;
  std::size_t corners;
  std::size_t dimension;
};
constexpr FebShape kFebioShapes[] = {{"tet", 4, 3}, {"hex", 8, 3},  {"penta", 6, 3}, {"pyra", 5, 3},
                                     {"tri", 3, 2}, {"quad", 4, 2}, {"line", 2, 1}};

/// Of a type such as "tet10" or "TET10G8".
const FebShape* shape_of(const std::string& type) {
  std::string name = lower(type);
  if (name == "ut4") name = "tet4";
  if (name.starts_with("q4")) name = "quad4";  // kinds of shells
  const auto* const found =
      std::find_if(std::begin(kFebioShapes), std::end(kFebioShapes), [&](const FebShape& shape) {
        return name.starts_with(shape.name) && name.size() > shape.name.size() &&
               name[shape.name.size()] >= '0' && name[shape.name.size()] <= '9';
      });
  return found == std::end(kFebioShapes) ? nullptr : found;
}

class FebReader {
 public:
  explicit FebReader(const Source& source) : source_(source), xml_(source), mesh_(source) {}

  MeshData read() {
    bool begun = false, ended = false;
    while (const std::optional<XmlTag> tag = xml_.next()) {
      beat(source_.watch);
      begun = begun || (!tag->closing && tag->name == "febio_spec");
      if (!begun) xml_.fail(*tag, "no file of FEBio: it does not begin with <febio_spec>");
      ended = ended || (tag->closing && tag->name == "febio_spec");
      use(*tag);
    }
    if (!ended)
      throw FileError(source_.path, "", "does not end with </febio_spec>; it is truncated or not FEBio's");
    if (const auto twice = numbers_.finish())
      throw FileError(source_.path, "", "the node " + std::to_string(*twice) + " occurs twice");
    if (mesh_.vertices.empty()) throw FileError(source_.path, "", "the file has no nodes");
    read_id_comments();
    for (const Element& element : elements_)
      if (!element.is_side) add(element);
    add_surfaces();
    mark_nodes();
    mesh_.names = {markers_.take(), regions_.take(), edges_.take(), points_.take()};
    return std::move(mesh_);
  }

 private:
  struct Element {
    const FebShape* shape;
    bool is_side;  ///< of a surface
    std::uint8_t count;
    std::size_t group;     ///< in `groups_`
    std::size_t first;     ///< in `nodes_of_elements_`
    std::size_t position;  ///< of the tag
  };
  struct Group {
    std::string name;
    std::size_t sides = 0;  ///< of a surface
  };
  struct NodeSet {
    std::string name;
    std::vector<std::int64_t> nodes;
    std::size_t position;
  };

  void use(const XmlTag& tag) {
    const std::string& name = tag.name;
    if (name == "Mesh" || name == "Geometry") {
      in_mesh_ = !tag.closing && !tag.empty;
      if (!tag.closing && !tag.attribute("from").empty())
        xml_.fail(tag, "the mesh is in another file, " + in_quotes(tag.attribute("from")) + "; read that");
      return;
    }
    if (!in_mesh_) return;
    if (tag.closing) {
      if (name == section_) section_.clear();
      return;
    }
    if (section_.empty())
      begin(tag);
    else if (section_ == "Nodes" && name == "node")
      read_node(tag);
    else if (section_ == "NodeSet" && (name == "node" || name == "n"))
      node_sets_.back().nodes.push_back(static_cast<std::int64_t>(xml_.number(tag, "id")));
    else if (section_ == "Elements" || section_ == "Surface" || section_ == "Edge")
      read_element(tag);
  }

  void begin(const XmlTag& tag) {
    if (tag.name == "Part" || tag.name == "Instance")
      xml_.fail(tag, "parts and their instances are not read; save the model with one mesh");
    const bool is_nodes = tag.name == "Nodes", is_set = tag.name == "NodeSet";
    const bool is_group = tag.name == "Elements" || tag.name == "Surface" || tag.name == "Edge";
    if (!is_nodes && !is_set && !is_group) return;
    if (is_group) {
      type_ = tag.attribute("type");
      groups_.push_back({unescaped(tag.attribute("name")), 0});
      if (groups_.back().name.empty() && !tag.attribute("mat").empty())
        groups_.back().name = "material " + unescaped(tag.attribute("mat"));
    }
    if (is_set) {
      node_sets_.push_back({unescaped(tag.attribute("name")), {}, tag.position});
      if (!tag.empty) read_integers(tag, node_sets_.back().nodes);
    }
    if (!tag.empty) section_ = tag.name;
  }

  /// The words of the text after a tag, between commas and blanks.
  template <typename Use>
  void for_each_word(Use&& use) const {
    constexpr std::string_view kSeparators = ", \t\r\n";
    std::string_view text = xml_.text();
    while (!text.empty()) {
      const std::size_t begin = text.find_first_not_of(kSeparators);
      if (begin == std::string_view::npos) return;
      const std::size_t end = std::min(text.find_first_of(kSeparators, begin), text.size());
      use(text.substr(begin, end - begin));
      text.remove_prefix(end);
    }
  }

  void read_integers(const XmlTag& tag, std::vector<std::int64_t>& values) {
    for_each_word([&](std::string_view word) {
      beat(source_.watch);
      std::int64_t value = 0;
      const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
      if (result.ec != std::errc() || result.ptr != word.data() + word.size())
        xml_.fail(tag, "expected the number of a node, found " + in_quotes(word));
      values.push_back(value);
    });
  }

  void read_node(const XmlTag& tag) {
    numbers_.add(static_cast<std::int64_t>(xml_.number(tag, "id")));
    Point point{};
    std::size_t axis = 0;
    for_each_word([&](std::string_view word) {
      double value = 0;
      const auto result = parse_real(word.data(), word.data() + word.size(), value);
      if (result.ec != std::errc() || result.ptr != word.data() + word.size() || axis == 3)
        xml_.fail(tag, "expected three coordinates, found " + in_quotes(word));
      if (source_.finite && !std::isfinite(value)) xml_.fail(tag, "a coordinate is not finite");
      point[axis++] = value;
    });
    if (axis < 3) xml_.fail(tag, "expected three coordinates");
    mesh_.vertices.push_back(point);
  }

  /// <elem> of the type of its section, or a tag named after its type.
  void read_element(const XmlTag& tag) {
    const std::string& type = tag.name == "elem" ? type_ : tag.name;
    const FebShape* const shape = shape_of(type);
    if (shape == nullptr) xml_.fail(tag, "elements of the type " + in_quotes(type) + " are not read");
    const std::size_t first = nodes_of_elements_.size();
    read_integers(tag, nodes_of_elements_);
    const std::size_t count = nodes_of_elements_.size() - first;
    if (count < shape->corners || count > kFebioMostNodes)
      xml_.fail(tag,
                "an element of the type " + in_quotes(type) + " with " + std::to_string(count) + " nodes");
    const bool is_side = section_ == "Surface";
    if (is_side && shape->dimension != 2) xml_.fail(tag, "a side of a surface is no triangle or quadrangle");
    if (is_side) ++groups_.back().sides;
    elements_.push_back(
        {shape, is_side, static_cast<std::uint8_t>(count), groups_.size() - 1, first, tag.position});
  }

  /// Holdfast's ids of names, in comments before the mesh.
  void read_id_comments() {
    const std::string_view head = source_.bytes.substr(0, source_.bytes.find("<Mesh"));
    for (std::size_t at = head.find("<!-- "); at != std::string_view::npos; at = head.find("<!-- ", at + 1)) {
      const std::size_t end = head.find(" -->", at);
      if (end == std::string_view::npos) return;
      read_id_comment(unescaped(head.substr(at + 4, end - at - 4)),
                      std::array{&regions_, &markers_, &edges_, &points_});
    }
  }

  Index vertex(std::int64_t number, std::size_t position) {
    const std::optional<Index> found = numbers_.find(number);
    if (!found) {
      XmlTag tag;
      tag.position = position;
      xml_.fail(tag, "the node " + std::to_string(number) + " does not exist");
    }
    return *found;
  }

  std::vector<Index> vertices_of(const Element& element) {
    std::vector<Index> n;
    for (std::size_t i = 0; i < element.count; ++i)
      n.push_back(vertex(nodes_of_elements_[element.first + i], element.position));
    return n;
  }

  void add(const Element& element) {
    beat(mesh_.watch);
    const std::vector<Index> n = vertices_of(element);
    const std::size_t corners = element.shape->corners;
    const std::string& name = groups_[element.group].name;
    if (element.shape->dimension == 2) return add_triangle(element, n, markers_.id_of(name));
    if (element.shape->dimension == 1) {
      const int id = edges_.id_of(name);
      if (n.size() == 3) return add_second_order(mesh_, Segment{n[0], n[1]}, n[2], id);
      return mesh_.add_segment({n[0], n[1]}, id);
    }
    const int region = regions_.id_of(name);
    if (corners > 4) return add_cell(mesh_, n, corners, region);
    const Tetrahedron tetrahedron{n[0], n[1], n[2], n[3]};
    if (n.size() == 10)
      return add_second_order(mesh_, tetrahedron, {n[4], n[5], n[6], n[7], n[8], n[9]}, region);
    mesh_.add_tetrahedron(tetrahedron, region);
    add_no_corners(mesh_, std::span(n).subspan(4));
  }

  void add_triangle(const Element& element, std::span<const Index> n, int marker) {
    if (element.shape->corners == 3 && n.size() == 6)
      return add_second_order(mesh_, Triangle{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, marker);
    add_polygon(mesh_, n.first(element.shape->corners), marker, [&](const std::string& reason) {
      XmlTag tag;
      tag.position = element.position;
      xml_.fail(tag, reason);
    });
    add_no_corners(mesh_, n.subspan(element.shape->corners));
  }

  /// Surfaces overlap shells and each other: the smallest counts.
  void add_surfaces() {
    settle_quadrangles(mesh_);  // so that the triangles of a quadrangle match
    FacetSets facets(mesh_);
    for (const Element& element : elements_) {
      if (!element.is_side) continue;
      beat(mesh_.watch);
      const Group& group = groups_[element.group];
      const SetOfFile set{markers_.id_of(group.name), group.sides};
      const std::vector<Index> n = vertices_of(element);
      for (const Triangle& side : facets.triangles_of(std::span(n).first(element.shape->corners)))
        facets.mark(side, set, [&] {
          if (n.size() == 6) return add_second_order(mesh_, side, {n[3], n[4], n[5]}, set.marker);
          mesh_.add_facet(side, set.marker);
          add_no_corners(mesh_, std::span(n).subspan(element.shape->corners));
        });
    }
    facets.finish();
  }

  void mark_nodes() {
    std::vector<VertexSet> sets;
    for (const NodeSet& set : node_sets_) {
      VertexSet vertices{points_.id_of(set.name), {}};
      for (const std::int64_t node : set.nodes) vertices.vertices.push_back(vertex(node, set.position));
      sets.push_back(std::move(vertices));
    }
    mark_vertices(mesh_, std::move(sets));
  }

  Source source_;
  XmlReader xml_;
  MeshData mesh_;
  bool in_mesh_ = false;
  std::string section_, type_;  ///< the section that is open, and the type of its elements
  Numbered numbers_;
  std::vector<Element> elements_;
  std::vector<std::int64_t> nodes_of_elements_;
  std::vector<Group> groups_;
  std::vector<NodeSet> node_sets_;
  NamedIds regions_{kRegionStem}, markers_{kFacetStem}, edges_{kSegmentStem}, points_{kVertexStem};
};

}  // namespace

MeshData read_febio(const Source& source) { return FebReader(source).read(); }

}  // namespace holdfast::io
