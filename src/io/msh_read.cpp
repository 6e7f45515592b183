// Reads Gmsh's .msh, versions 1 (which states no version), 2.x, 3, 4.0 and 4.1, ASCII and binary (Gmsh
// reference manual, "File formats" and "Legacy formats").
//
// A marker or region is the first physical tag or, without one, the elementary entity's tag; the marker of a
// vertex is the physical tag of a point element. Names are those of the physical groups. Vertices are sorted
// by node tag, the order in which Holdfast numbers them.
#include <algorithm>
#include <optional>
#include <set>
#include <span>

#include "io/cells.h"
#include "io/entity_ids.h"
#include "io/fluent.h"
#include "io/formats.h"
#include "io/labels.h"
#include "io/mid_nodes.h"
#include "io/msh_groups.h"
#include "io/msh_nodes.h"
#include "io/msh_numbers.h"
#include "io/msh_of_others.h"
#include "io/msh_types.h"
#include "io/polygon.h"

namespace holdfast::io {
namespace {

enum class MshVersion { v1, v2, v3, v4_0, v4_1 };

class MshReader {
 public:
  explicit MshReader(const Source& source) : in_(source), text_(in_.text()), mesh_(source) {}

  MeshData read() {
    const std::string_view first = text_.word("$MeshFormat");
    if (first != "$MeshFormat" && first != "$NOD") text_.fail(why_no_gmsh_mesh(first));
    first == "$NOD" ? read_section("$NOD") : read_format();
    while (!text_.at_end()) read_section(std::string(text_.word("a section")));
    for (std::size_t i = 0; i < point_markers_.size(); ++i) mesh_.vertex_markers.add(i, point_markers_[i]);
    mesh_.names = {names_[2].take(), names_[3].take(), names_[1].take(), names_[0].take()};
    ids_.part(mesh_);
    groups_.tell(mesh_);
    return std::move(mesh_);
  }

 private:
  void read_format() {
    const std::string version(text_.word("the version"));
    if (version == "2" || version.starts_with("2."))
      version_ = MshVersion::v2;
    else if (version == "3" || version == "3.0")
      version_ = MshVersion::v3;
    else if (version == "4" || version == "4.0")
      version_ = MshVersion::v4_0;
    else if (version == "4.1")
      version_ = MshVersion::v4_1;
    else
      text_.fail("version " + in_quotes(version) + " is not read; save it as 4.1 or 2.2");
    const std::int64_t type = text_.integer("the file type");
    if (type != 0 && type != 1) text_.fail("the file type is neither 0 (text) nor 1 (binary)");
    const std::int64_t size = text_.integer("the data size");
    if (type == 1) read_byte_order(size);
    expect_end("$EndMeshFormat");
  }

  /// The bytes of the number 1 show the byte order.
  void read_byte_order(std::int64_t size) {
    if (size != 8 && !(has_entities() && size == 4))
      text_.fail("numbers of " + std::to_string(size) + " bytes are not read");
    text_.skip_line();
    const std::string_view one = text_.remaining().substr(0, 4);
    if (one.size() < 4) text_.fail_truncated("the number 1, which shows the byte order");
    for (const std::endian order : {std::endian::little, std::endian::big})
      if (load<std::int32_t>(one.data(), order) == 1) in_.set_binary(order, static_cast<std::size_t>(size));
    if (!in_.binary()) text_.fail("the number 1, which shows the byte order, is missing");
    text_.seek(text_.position() + 4);
  }

  void expect_end(std::string_view end) {
    const std::string_view word = text_.word(end);
    if (word != end) text_.fail("expected " + std::string(end) + ", found " + in_quotes(word));
  }

  void read_section(const std::string& name) {
    if (!name.starts_with('$')) text_.fail("expected a section, found " + in_quotes(name));
    if (name == (version_ == MshVersion::v1 ? "$NOD" : "$Nodes")) {
      if (nodes_.size() > 0) text_.fail("a second section of nodes");
      has_entities() ? read_nodes_4() : read_nodes();
      nodes_.finish(in_);
      mesh_.vertices = nodes_.take_points();
      expect_end(version_ == MshVersion::v1 ? "$ENDNOD" : "$EndNodes");
    } else if (version_ == MshVersion::v1 && name == "$ELM") {
      read_elements_1();
      expect_end("$ENDELM");
    } else if (name == "$Elements") {
      has_entities() ? read_elements_4() : version_ == MshVersion::v3 ? read_elements_3() : read_elements_2();
      expect_end("$EndElements");
    } else if (name == "$PhysicalNames") {
      read_names();
      expect_end("$EndPhysicalNames");
    } else if (name == "$Entities" && (has_entities() || version_ == MshVersion::v3)) {
      has_entities() ? read_entities() : read_entities_3();
      expect_end("$EndEntities");
    } else if (name == "$PartitionedEntities" && has_entities()) {
      read_partitioned_entities();
      expect_end("$EndPartitionedEntities");
    } else {
      skip_section((version_ == MshVersion::v1 ? "$END" : "$End") + name.substr(1));
      if (name != "$Entities" && name != "$Comments")
        mesh_.remarks.push_back({RemarkKind::left_out, 1, "the section " + name + " is left out"});
    }
  }

  /// Reads lines with a dimension, a tag and a quoted name, which are text even in binary files.
  void read_names() {
    const std::size_t count = text_.count("the number of names", 5);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t dimension = text_.integer("a dimension");
      if (dimension < 0 || dimension > 3) text_.fail("a dimension outside 0 to 3");
      const int tag = text_.tag("a physical tag");
      const std::string_view rest = text_.rest_of_line();
      const std::size_t start = rest.find('"'), end = rest.rfind('"');
      if (start == end) text_.fail("expected a name in quotes, found " + in_quotes(rest));
      names_[static_cast<std::size_t>(dimension)].set(tag,
                                                      std::string(rest.substr(start + 1, end - start - 1)));
    }
  }

  void skip_section(const std::string& end) {
    if (in_.binary()) {
      const std::size_t found = text_.remaining().find("\n" + end);
      if (found == std::string_view::npos) text_.fail_truncated(end);
      text_.seek(text_.position() + found + 1 + end.size());
      return;
    }
    text_.skip_line();
    while (!text_.at_end()) {
      if (text_.word_on_line() == end) return;
      text_.skip_line();
    }
    text_.fail_truncated(end);
  }

  void read_nodes() {
    const std::size_t count = in_.text_count("the number of nodes", 8, 28);
    in_.begin();
    nodes_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      nodes_.add_tag(in_.integer("a node tag"));
      nodes_.add_point(in_.point());
      if (version_ == MshVersion::v3 && in_.integer("an entity tag, or 0") != 0)
        skip_parameters(in_.integer("a dimension"));
    }
  }

  /// Skips the parameters of a node on its entity.
  void skip_parameters(std::int64_t dimension) {
    for (std::int64_t axis = 0; axis < std::min<std::int64_t>(dimension, 3); ++axis)
      static_cast<void>(in_.real("a parametric coordinate"));
  }

  /// Reads elements of version 1: physical and elementary tags, then the number of nodes.
  void read_elements_1() {
    const std::size_t count = text_.count("the number of elements", 12);
    for (std::size_t i = 0; i < count; ++i) {
      static_cast<void>(in_.integer("an element tag"));
      const std::int64_t type = in_.integer("an element type");
      const int physical = in_.tag("a physical tag"), elementary = in_.tag("an elementary tag");
      static_cast<void>(in_.integer("the number of nodes"));
      if (!groups_.is_one_before(in_, type, physical, elementary)) read_element(type, physical, elementary);
    }
  }

  /// Binary elements come in groups of one type; in text, each element is a group.
  void read_elements_2() {
    const std::size_t count = in_.text_count("the number of elements", 6, 8);
    in_.begin();
    for (std::size_t done = 0; done < count;) {
      if (!in_.binary()) static_cast<void>(in_.integer("an element tag"));
      const std::int64_t type = in_.integer("an element type");
      const std::size_t group = in_.binary() ? in_.short_count("the number of elements", 1, 8) : 1;
      if (group == 0 || group > count - done) in_.fail("a group of elements that is empty or too large");
      const std::size_t tags = in_.short_count("the number of tags", 2, 4);
      for (std::size_t i = 0; i < group; ++i, ++done) {
        if (in_.binary()) static_cast<void>(in_.integer("an element tag"));
        int physical = 0, elementary = 0;
        for (std::size_t tag = 0; tag < tags; ++tag) {
          const int value = in_.tag("a tag");
          if (tag == 0) physical = value;
          if (tag == 1) elementary = value;
        }
        if (!groups_.is_one_before(in_, type, physical, elementary)) read_element(type, physical, elementary);
      }
    }
  }

  /// Reads elements of version 3, each with its entity, and with its parts after its nodes.
  void read_elements_3() {
    const std::size_t count = in_.text_count("the number of elements", 8, 16);
    in_.begin();
    for (std::size_t i = 0; i < count; ++i) {
      static_cast<void>(in_.integer("an element tag"));
      const std::int64_t type = in_.integer("an element type");
      const int entity = in_.tag("an entity tag");
      const std::size_t numbers = in_.short_count("the number of nodes and parts", 2, 4);
      const std::optional<MshKind> kind = kind_of(type);
      if (!kind) in_.fail("elements of type " + std::to_string(type) + " are not read");
      if (numbers < kind->nodes)
        in_.fail("an element of type " + std::to_string(type) + " with " + std::to_string(numbers) +
                 " nodes; it has " + std::to_string(kind->nodes));
      read_element(type, groups_.of({kind->dimension, entity}), entity);
      for (std::size_t k = kind->nodes; k < numbers; ++k) static_cast<void>(in_.integer("a part"));
    }
  }

  /// Reads entities of version 3, which are text even in binary files.
  void read_entities_3() {
    std::array<std::size_t, 4> counts{};
    for (std::size_t& count : counts) count = text_.count("the number of entities", 2);
    for (std::size_t dimension = 0; dimension < 4; ++dimension)
      for (std::size_t i = 0; i < counts[dimension]; ++i) {
        const std::int64_t tag = text_.integer("an entity tag");
        const std::size_t borders = dimension == 0 ? 0 : text_.count("the number of bounding entities", 2);
        for (std::size_t k = 0; k < borders; ++k) static_cast<void>(text_.integer("an entity tag"));
        const std::size_t physicals = text_.count("the number of physical tags", 2);
        for (std::size_t k = 0; k < physicals; ++k)
          groups_.note({dimension, tag}, text_.tag("a physical tag"));
      }
  }

  /// Reads the physical tags of the entities of each dimension.
  void read_entities() {
    in_.begin();
    std::array<std::size_t, 4> counts{};
    for (std::size_t& count : counts) count = in_.count("the number of entities", 10, 4);
    for (std::size_t dimension = 0; dimension < 4; ++dimension)
      for (std::size_t i = 0; i < counts[dimension]; ++i)
        read_bounds_and_physicals(dimension, in_.integer("an entity tag"));
  }

  /// Reads what follows the tag of an entity of either kind.
  void read_bounds_and_physicals(std::size_t dimension, std::int64_t tag) {
    const int bounds = dimension == 0 && version_ == MshVersion::v4_1 ? 3 : 6;
    for (int bound = 0; bound < bounds; ++bound) static_cast<void>(in_.real("a bound"));
    const std::size_t physicals = in_.count("the number of physical tags", 2, 4);
    for (std::size_t k = 0; k < physicals; ++k) groups_.note({dimension, tag}, in_.tag("a physical tag"));
    if (dimension == 0) return;
    const std::size_t borders = in_.count("the number of bounding entities", 2, 4);
    for (std::size_t k = 0; k < borders; ++k) static_cast<void>(in_.integer("an entity tag"));
  }

  /// Reads entities by part. An entity whose parent has more dimensions lies between parts and is not part of
  /// the mesh.
  void read_partitioned_entities() {
    in_.begin();
    static_cast<void>(in_.size("the number of parts"));
    const std::size_t ghosts = in_.count("the number of ghost entities", 4, 8);
    for (std::size_t i = 0; i < 2 * ghosts; ++i) static_cast<void>(in_.integer("a ghost entity"));
    std::array<std::size_t, 4> counts{};
    for (std::size_t& count : counts) count = in_.count("the number of entities", 10, 4);
    for (std::size_t dimension = 0; dimension < 4; ++dimension)
      for (std::size_t i = 0; i < counts[dimension]; ++i) {
        const std::int64_t tag = in_.integer("an entity tag");
        const std::int64_t parent = in_.integer("the dimension of the parent");
        static_cast<void>(in_.integer("the tag of the parent"));
        const std::size_t parts = in_.count("the number of parts", 2, 4);
        for (std::size_t k = 0; k < parts; ++k) static_cast<void>(in_.integer("a part"));
        read_bounds_and_physicals(dimension, tag);
        if (parent > static_cast<std::int64_t>(dimension)) between_.insert({dimension, tag});
      }
  }

  /// The nodes or elements of an entity.
  struct Block {
    std::int64_t dimension;
    int entity;
    std::int64_t kind;  ///< whether nodes are parametric, or the type of the elements
    std::size_t count;
  };
  Block read_block(const char* kind, const char* count, std::size_t bytes_text, std::size_t bytes_binary) {
    Block block{};
    if (version_ == MshVersion::v4_0) block.entity = in_.tag("an entity tag");
    block.dimension = in_.integer("a dimension");
    if (version_ != MshVersion::v4_0) block.entity = in_.tag("an entity tag");
    block.kind = in_.integer(kind);
    block.count = in_.count(count, bytes_text, bytes_binary);
    return block;
  }
  /// Version 4.1 states the bounds of tags before the blocks.
  void skip_bounds(const char* least, const char* largest) {
    if (version_ == MshVersion::v4_0) return;
    static_cast<void>(in_.size(least));
    static_cast<void>(in_.size(largest));
  }

  void read_nodes_4() {
    in_.begin();
    const std::size_t blocks = in_.count("the number of blocks", 8, 12);
    nodes_.reserve(in_.count("the number of nodes", 8, 24));
    skip_bounds("the least node tag", "the largest node tag");
    for (std::size_t i = 0; i < blocks; ++i) {
      const Block block = read_block("the parametric flag", "the number of nodes", 8, 24);
      const bool tags_first = version_ == MshVersion::v4_1;
      for (std::size_t k = 0; tags_first && k < block.count; ++k) nodes_.add_tag(node_tag());
      for (std::size_t k = 0; k < block.count; ++k) {
        if (!tags_first) nodes_.add_tag(node_tag());
        nodes_.add_point(in_.point());
        if (block.kind != 0) skip_parameters(block.dimension);
      }
    }
  }

  void read_elements_4() {
    in_.begin();
    const std::size_t blocks = in_.count("the number of blocks", 8, 12);
    static_cast<void>(in_.size("the number of elements"));
    skip_bounds("the least element tag", "the largest element tag");
    for (std::size_t i = 0; i < blocks; ++i) {
      const Block block = read_block("an element type", "the number of elements", 4, 4);
      const std::pair entity{static_cast<std::size_t>(block.dimension), std::int64_t{block.entity}};
      const int physical = groups_.of(entity), elementary = physical != 0 ? 0 : block.entity;
      const bool between = between_.contains(entity);
      for (std::size_t k = 0; k < block.count; ++k) {
        static_cast<void>(node_tag());  // of the element; it has the size of a node tag
        if (between)
          skip_element(block.kind);
        else
          read_element(block.kind, physical, elementary);
      }
    }
  }

  void skip_element(std::int64_t type) {
    const std::optional<MshKind> kind = kind_of(type);
    if (!kind || kind->dimension > 2)
      in_.fail("elements of type " + std::to_string(type) + " do not lie between parts");
    for (std::size_t i = 0; i < kind->nodes; ++i) static_cast<void>(node_tag());
  }

  [[nodiscard]] bool has_entities() const {
    return version_ == MshVersion::v4_0 || version_ == MshVersion::v4_1;
  }
  std::int64_t node_tag() {
    return version_ == MshVersion::v4_1 ? in_.size("a node tag") : in_.integer("a node tag");
  }

  template <std::size_t N>
  std::array<Index, N> corners() {
    std::array<Index, N> result{};
    for (Index& corner : result) corner = nodes_.index(in_, node_tag());
    return result;
  }

  void read_element(std::int64_t type, int physical, int elementary) {
    EntityIds::Ids ids{names_[0].resolve(physical)};
    for (std::size_t d = 1; d < 4; ++d) ids[d] = physical != 0 ? names_[d].resolve(physical) : elementary;
    add_element(type, ids);
    ids_.note(mesh_, physical != 0, ids);
  }

  void add_element(std::int64_t type, const EntityIds::Ids& ids) {
    const auto [point, segment, facet, region] = ids;
    switch (type) {
      case 1:
        return mesh_.add_segment(corners<2>(), segment);
      case 2:
        return mesh_.add_facet(corners<3>(), facet);
      case 3:
        return add_polygon(mesh_, corners<4>(), facet, [&](const std::string& reason) { in_.fail(reason); });
      case 4:
        return mesh_.add_tetrahedron(corners<4>(), region);
      case 8: {
        const auto n = corners<3>();
        return add_second_order(mesh_, Segment{n[0], n[1]}, n[2], segment);
      }
      case 9: {
        const auto n = corners<6>();
        return add_second_order(mesh_, Triangle{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, facet);
      }
      case 11: {  // Gmsh swaps the last two edges
        const auto n = corners<10>();
        return add_second_order(mesh_, Tetrahedron{n[0], n[1], n[2], n[3]},
                                {n[4], n[5], n[6], n[7], n[9], n[8]}, region);
      }
      case 15:
        point_markers_.resize(mesh_.vertices.size(), 0);
        point_markers_[corners<1>()[0]] = point;
        return;
      default:
        read_by_corners(type, ids);
    }
  }

  /// Reads an element of higher order, a quadrangle of second order, or a cell that is split: its corners
  /// come first.
  void read_by_corners(std::int64_t type, const EntityIds::Ids& ids) {
    const MshByCorners* const found = by_corners(type);
    if (found == nullptr) in_.fail("elements of type " + std::to_string(type) + " are not read");
    std::vector<Index> n(found->nodes);
    for (Index& node : n) node = nodes_.index(in_, node_tag());
    switch (found->shape) {
      case MshShape::line:
        mesh_.add_segment({n[0], n[1]}, ids[1]);
        break;
      case MshShape::triangle:
        mesh_.add_facet({n[0], n[1], n[2]}, ids[2]);
        break;
      case MshShape::quadrangle:
        add_polygon(mesh_, std::span(n).first(4), ids[2],
                    [&](const std::string& reason) { in_.fail(reason); });
        break;
      case MshShape::tetrahedron:
        mesh_.add_tetrahedron({n[0], n[1], n[2], n[3]}, ids[3]);
        break;
      case MshShape::hexahedron:
      case MshShape::prism:
      case MshShape::pyramid:
        return add_cell(mesh_, n, corners_of(found->shape), ids[3]);
    }
    add_no_corners(mesh_, std::span(n).subspan(corners_of(found->shape)));
  }

  MshNumbers in_;
  TextReader& text_;
  MshVersion version_ = MshVersion::v1;
  MshNodes nodes_;
  MshGroups groups_;
  std::set<std::pair<std::size_t, std::int64_t>> between_;  ///< entities between parts
  std::vector<int> point_markers_;                          ///< by vertex, if any is marked
  std::array<NamedIds, 4> names_{NamedIds(kVertexStem), NamedIds(kSegmentStem), NamedIds(kFacetStem),
                                 NamedIds(kRegionStem)};  ///< by dimension
  EntityIds ids_;
  MeshData mesh_;
};

}  // namespace

MeshData read_msh(const Source& source) {
  if (is_inp(source.bytes)) return read_inp(source);
  return is_fluent(source.bytes) ? read_fluent(source) : MshReader(source).read();
}

MeshData read_msh_surface(const Source& source) {
  return is_fluent(source.bytes) ? read_fluent_surface(source) : read_msh(source);
}

}  // namespace holdfast::io
