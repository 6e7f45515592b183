// Reads Ansys MAPDL's archive files, .cdb (CDWRITE): nodes (NBLOCK), elements (EBLOCK) and components
// (CMBLOCK). Materials are regions and markers, with the name of the component of the same elements.
#include <algorithm>
#include <limits>
#include <map>

#include "io/cdb_model.h"
#include "io/cdb_text.h"
#include "io/cells.h"
#include "io/file_sets.h"
#include "io/formats.h"
#include "io/mid_nodes.h"
#include "io/polygon.h"

namespace holdfast::io {
namespace {

constexpr std::size_t kMostNodes = 20;  // of an element

class CdbReader {
 public:
  explicit CdbReader(const Source& source) : text_(source), mesh_(source) {}

  MeshData read() {
    while (is_read_ || text_.next()) {
      is_read_ = false;
      use_command();
    }
    if (const auto twice = model_.nodes.finish())
      throw FileError(text_.source().path, "", "the node " + std::to_string(*twice) + " occurs twice");
    if (mesh_.vertices.empty()) throw FileError(text_.source().path, "", "the file has no NBLOCK");
    std::size_t overlaps = 0;
    const std::vector<int> ids = ids_of_elements(model_, ids_, overlaps);
    for (std::size_t e = 0; e < ids.size(); ++e) add(model_.elements[e], ids[e]);
    mesh_.leave_out(overlaps, "memberships of elements in larger components",
                    "membership of an element in a larger component");
    mark_components();
    tell_skipped();
    const auto take = [&](CdbShape shape) { return ids_[static_cast<std::size_t>(shape)].take(); };
    mesh_.names = {take(CdbShape::surface), take(CdbShape::solid), take(CdbShape::line), points_.take()};
    return std::move(mesh_);
  }

 private:
  void use_command() {
    const std::string command = text_.command();
    if (command == "et")
      read_type();
    else if (command.starts_with("keyop"))
      read_option();
    else if (command == "type")
      type_ = number(1, "a type");
    else if (command == "nblock")
      read_nodes();
    else if (command == "eblock")
      read_elements();
    else if (command == "cmblock")
      read_component();
    else if (command == "/com" && text_.line().size() > 5)
      read_id_comment(text_.line().substr(5), std::array{&points_});
  }

  /// An argument of this line; 0 if it is missing.
  int number(std::size_t i, std::string_view what) const {
    const std::vector<std::string_view> all = text_.arguments();
    return i < all.size() && !all[i].empty() ? id_of(text_.reader(), all[i], what) : 0;
  }

  /// ET,1,187 or ET,1,SOLID187, and the first option.
  void read_type() {
    const std::vector<std::string_view> all = text_.arguments();
    if (all.size() < 3) return;
    const std::size_t digits = all[2].find_last_not_of("0123456789");
    const std::string_view name = digits == std::string_view::npos ? all[2] : all[2].substr(digits + 1);
    if (name.empty()) return;
    types_[number(1, "a type")] = {id_of(text_.reader(), name, "an element's type"), number(3, "an option")};
  }

  /// KEYOPT,1,1,4
  void read_option() {
    if (number(2, "an option") == 1) types_[number(1, "a type")].option = number(3, "an option");
  }

  void read_nodes() {
    const CdbColumns columns = text_.read_format();
    if (columns.real_width == 0) text_.fail("the format of NBLOCK has no real numbers");
    while (next_of_block("the end of NBLOCK, N,R5.3,LOC,-1")) {
      if (text_.ends_block(columns)) return leave_block();
      model_.node_numbers.push_back(text_.integer(columns, 0, "a node's number"));
      model_.nodes.add(model_.node_numbers.back());
      Point point{};
      for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = text_.real(columns, axis, "a coordinate");
      mesh_.vertices.push_back(point);
    }
  }

  bool next_of_block(std::string_view what) {
    if (!text_.next()) text_.fail_truncated(what);
    return true;
  }
  /// The line after a block may be a command.
  void leave_block() { is_read_ = text_.command() != "-1" && text_.command() != "n"; }

  void read_elements() {
    const std::vector<std::string_view> all = text_.arguments();
    const bool is_solid = all.size() > 2 && lower(all[2]) == "solid";
    const CdbColumns columns = text_.read_format();
    while (next_of_block("the end of EBLOCK, -1")) {
      if (text_.ends_block(columns)) return leave_block();
      if (is_solid)
        read_element(columns);
      else
        read_plain_element(columns);
    }
  }

  CdbElement element(const CdbColumns& columns, std::size_t number, int type, std::size_t material) {
    const auto found = types_.find(type);
    if (found == types_.end()) text_.fail("the element type " + std::to_string(type) + " does not exist");
    const std::int64_t id = text_.integer(columns, material, "a material");
    if (id < 0 || id > std::numeric_limits<int>::max()) text_.fail("the material does not fit 32 bits");
    const CdbShape shape = shape_of(found->second);
    if (shape == CdbShape::other) ++skipped_[found->second.name];
    return {text_.integer(columns, number, "an element's number"),
            found->second,
            shape,
            0,
            static_cast<int>(id),
            model_.nodes_of_elements.size(),
            text_.place()};
  }

  /// Material, type, ..., number of nodes, element, eight nodes; others on lines of their own.
  void read_element(const CdbColumns& columns) {
    constexpr std::size_t kMaterial = 0, kType = 1, kCount = 8, kNumber = 10, kNodes = 11;
    const auto type = static_cast<int>(text_.integer(columns, kType, "a type"));
    CdbElement added = element(columns, kNumber, type, kMaterial);
    const std::int64_t count = text_.integer(columns, kCount, "a number of nodes");
    if (count < 1 || count > static_cast<std::int64_t>(kMostNodes))
      text_.fail("an element of " + std::to_string(count) + " nodes");
    added.count = static_cast<std::uint8_t>(count);
    for (std::size_t i = 0, column = kNodes; i < static_cast<std::size_t>(count); ++i, ++column) {
      if (i == 8 || (i > 8 && column == columns.integers)) {
        next_of_block("the nodes of an element");
        column = 0;
      }
      model_.nodes_of_elements.push_back(text_.integer(columns, column, "a node's number"));
    }
    model_.elements.push_back(added);
  }

  /// Element, section, real constants, material, coordinate system, nodes; the type is that of TYPE.
  void read_plain_element(const CdbColumns& columns) {
    constexpr std::size_t kNumber = 0, kMaterial = 3, kNodes = 5;
    CdbElement added = element(columns, kNumber, type_, kMaterial);
    for (std::size_t column = kNodes; column < columns.integers && added.count < kMostNodes; ++column) {
      const std::int64_t node = text_.integer(columns, column, "a node's number");
      if (node == 0 && column * columns.integer_width >= text_.line().size()) break;
      model_.nodes_of_elements.push_back(node);
      ++added.count;
    }
    model_.elements.push_back(added);
  }

  /// surface__4 is -4 without a name: names have no other sign than the underscore.
  static std::string name_of(std::string_view written) {
    std::string name(written);
    for (const std::string_view stem : {kRegionStem, kFacetStem, kSegmentStem, kVertexStem}) {
      const std::string negative = std::string(stem) + "__";
      if (name.starts_with(negative) && name.size() > negative.size() &&
          name.find_first_not_of("0123456789", negative.size()) == std::string::npos)
        name[negative.size() - 1] = '-';
    }
    return name;
  }

  void read_component() {
    const std::vector<std::string_view> all = text_.arguments();
    if (all.size() < 4) text_.fail("CMBLOCK without a name, a kind and a count");
    CdbComponent component{name_of(all[1]), lower(all[2]).starts_with("node"), {}};
    const std::string_view announced = trimmed(all[3].substr(0, all[3].find('!')));
    const std::int64_t count = integer_of(text_.reader(), announced, "a number of members");
    const std::size_t left = text_.reader().remaining().size();
    if (count < 0 || static_cast<std::uint64_t>(count) > left)
      text_.fail("a component of " + std::to_string(count) + " members, but only " + std::to_string(left) +
                 " bytes follow; the file is truncated or damaged");
    const CdbColumns columns = text_.read_format();
    for (std::int64_t i = 0; i < count; ++i) {
      const std::size_t column = static_cast<std::size_t>(i) % columns.integers;
      if (column == 0) next_of_block("the members of a component");
      component.members.push_back(text_.integer(columns, column, "a member of a component"));
    }
    model_.components.push_back(std::move(component));
  }

  void add(const CdbElement& element, int id) {
    beat(mesh_.watch);
    if (element.shape == CdbShape::other) return;
    std::array<Index, kMostNodes> n{};
    const std::span<const std::int64_t> nodes =
        std::span(model_.nodes_of_elements).subspan(element.first, element.count);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      n[i] = no_entity;  // a missing node on an edge
      if (nodes[i] == 0) continue;
      const std::optional<Index> found = model_.nodes.find(nodes[i]);
      if (!found) text_.fail_at(element.place, "the node " + std::to_string(nodes[i]) + " does not exist");
      n[i] = *found;
    }
    const std::span<const Index> all = std::span<const Index>(n).first(nodes.size());
    if (element.shape == CdbShape::solid)
      add_solid(element, all, id);
    else if (element.shape == CdbShape::surface)
      add_surface(element, all, id);
    else
      add_line(element, all, id);
  }

  /// Whether the first nodes are all there.
  static bool has_corners(std::span<const Index> nodes, std::size_t corners) {
    return nodes.size() >= corners &&
           std::find(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(corners), no_entity) ==
               nodes.begin() + static_cast<std::ptrdiff_t>(corners);
  }

  static std::vector<Index> without_missing(std::span<const Index> nodes) {
    std::vector<Index> result(nodes.begin(), nodes.end());
    std::erase(result, no_entity);
    return result;
  }

  void add_tetrahedron(const Tetrahedron& corners, const std::array<Index, 6>& mids, int region) {
    if (std::find(mids.begin(), mids.end(), no_entity) == mids.end())
      return add_second_order(mesh_, corners, mids, region);
    mesh_.add_tetrahedron(corners, region);
    add_no_corners(mesh_, without_missing(mids));
  }

  void add_solid(const CdbElement& element, std::span<const Index> n, int region) {
    const bool is_tetrahedron = n.size() == 4 || n.size() == 10;
    if ((!is_tetrahedron && n.size() != 8 && n.size() != 20) || !has_corners(n, is_tetrahedron ? 4 : 8))
      text_.fail_at(element.place, "a solid element of " + std::to_string(n.size()) +
                                       " nodes; those of 4, 8, 10 and 20 are read");
    if (n.size() == 4) return mesh_.add_tetrahedron({n[0], n[1], n[2], n[3]}, region);
    if (n.size() == 10)
      return add_tetrahedron({n[0], n[1], n[2], n[3]}, {n[4], n[5], n[6], n[7], n[8], n[9]}, region);
    const auto tetrahedron = degenerate_tetrahedron(n.first(8));
    if (!tetrahedron) return add_cell(mesh_, without_missing(n), 8, region);
    if (n.size() == 8) return mesh_.add_tetrahedron(*tetrahedron, region);
    // Of a hexahedron's edges, those of the tetrahedron (I J K K M M M M).
    add_tetrahedron(*tetrahedron, {n[8], n[9], n[11], n[16], n[17], n[18]}, region);
  }

  /// A triangle may be a quadrangle of repeated corners; nodes on edges follow the corners.
  void add_surface(const CdbElement& element, std::span<const Index> n, int marker) {
    const bool is_triangle = n.size() == 3 || n.size() == 6 || (n.size() > 3 && n[3] == n[2]);
    if (!has_corners(n, is_triangle ? 3 : 4))
      text_.fail_at(element.place, "a surface element of fewer than 3 nodes");
    std::array<Index, 3> mids{no_entity, no_entity, no_entity};
    if (n.size() == 6) mids = {n[3], n[4], n[5]};
    if (is_triangle && n.size() >= 8) mids = {n[4], n[5], n[7]};
    if (std::find(mids.begin(), mids.end(), no_entity) == mids.end())
      return add_second_order(mesh_, Triangle{n[0], n[1], n[2]}, mids, marker);
    add_polygon(mesh_, n.first(is_triangle ? 3 : 4), marker,
                [&](const std::string& reason) { text_.fail_at(element.place, reason); });
    if (n.size() >= 8) add_no_corners(mesh_, without_missing(n.subspan(4, 4)));
  }

  void add_line(const CdbElement& element, std::span<const Index> n, int marker) {
    if (!has_corners(n, 2)) text_.fail_at(element.place, "a line of fewer than 2 nodes");
    const bool has_middle = element.type.name == kMesh200 && element.type.option == kMesh200Line3;
    if (has_middle && has_corners(n, 3)) return add_second_order(mesh_, Segment{n[0], n[1]}, n[2], marker);
    mesh_.add_segment({n[0], n[1]}, marker);
  }

  /// Without surface elements, components of nodes mark the faces of the boundary that have all corners in
  /// them; others mark vertices.
  void mark_components() {
    const bool has_facets = !mesh_.facets.empty();
    std::vector<Triangle> boundary;
    if (!has_facets) boundary = boundary_of(mesh_);
    FacetSets facets(mesh_);
    const NodesOnEdges on_edges(mesh_);
    std::vector<VertexSet> of_vertices;
    NamedIds& markers = ids_[static_cast<std::size_t>(CdbShape::surface)];
    std::vector<std::vector<Index>> all = vertices_of_components(model_);
    std::vector<std::size_t> last(mesh_.vertices.size(), all.size());  // component of each vertex
    for (std::size_t c = 0; c < all.size(); ++c) {
      if (all[c].empty()) continue;
      for (const Index v : all[c]) last[v] = c;
      std::vector<Triangle> inside;
      for (const Triangle& face : boundary) {
        beat(mesh_.watch);
        if (last[face[0]] == c && last[face[1]] == c && last[face[2]] == c) inside.push_back(face);
      }
      const std::string& name = model_.components[c].name;
      if (inside.empty()) {
        of_vertices.push_back({points_.id_of(name), std::move(all[c])});
        continue;
      }
      const SetOfFile set{markers.id_of(name), inside.size()};
      for (const Triangle& face : inside)
        facets.mark(face, set, [&] { on_edges.add_facet(mesh_, face, set.marker); });
    }
    facets.finish();
    mark_vertices(mesh_, std::move(of_vertices));
  }

  void tell_skipped() {
    mesh_.leave_out(
        skipped_, [](int type) { return std::to_string(type); }, "elements of other types",
        "element of another type");
  }

  CdbText text_;
  bool is_read_ = false;  ///< the current line is not used yet
  MeshData mesh_;
  CdbModel model_;
  std::map<int, CdbType> types_;
  int type_ = 1;  ///< that TYPE names
  CdbIds ids_{NamedIds(kFacetStem), NamedIds(kRegionStem), NamedIds(kSegmentStem)};
  NamedIds points_{kVertexStem};
  std::map<int, std::size_t> skipped_;
};

}  // namespace

MeshData read_cdb(const Source& source) { return CdbReader(source).read(); }

}  // namespace holdfast::io
