// Reads Exodus II files (Cubit, MOOSE, Sierra, ParaView, meshio), in netCDF's classic format or netCDF-4:
// blocks of elements become regions and facets, side sets facets, and node sets markers of vertices.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>

#include "io/cells.h"
#include "io/exodus.h"
#include "io/file_sets.h"
#include "io/formats.h"
#include "io/labels.h"
#include "io/mid_nodes.h"
#include "io/netcdf_read.h"
#include "io/polygon.h"
#include "io/text_reader.h"
#include "numbers/sorted.h"

namespace holdfast::io {
namespace {

enum class ExodusShape { point, line, triangle, quadrangle, tetrahedron, cell };

struct ElementBlock {
  std::string name;  ///< of its array of nodes
  ExodusShape shape = ExodusShape::point;
  std::size_t nodes_each = 0, corners = 0;
  std::size_t first = 0, count = 0;  ///< elements, in the numbers of the file less 1
  std::vector<Index> nodes;
  std::vector<Index> entities;  ///< of its elements: the first tetrahedron or facet of each, and the end
};

/// The shape of elements that are called "TETRA", "HEX8" and the like, and their number of corners.
std::optional<std::pair<ExodusShape, std::size_t>> shape_of(const std::string& type, std::size_t nodes) {
  const std::string name = lower(type);
  const auto begins = [&](std::initializer_list<std::string_view> words) {
    return std::any_of(words.begin(), words.end(), [&](std::string_view w) { return name.starts_with(w); });
  };
  std::pair<ExodusShape, std::size_t> found;
  if (begins({"tet"}))
    found = {ExodusShape::tetrahedron, 4};
  else if (begins({"hex"}))
    found = {ExodusShape::cell, 8};
  else if (begins({"wedge"}))
    found = {ExodusShape::cell, 6};
  else if (begins({"pyr"}))
    found = {ExodusShape::cell, 5};
  else if (begins({"tri"}) || (begins({"shell"}) && (nodes == 3 || nodes == 6 || nodes == 7)))
    found = {ExodusShape::triangle, 3};
  else if (begins({"quad", "shell"}))
    found = {ExodusShape::quadrangle, 4};
  else if (begins({"bar", "beam", "truss", "edge", "rod", "line"}))
    found = {ExodusShape::line, 2};
  else if (begins({"sphere", "circle", "point", "node", "particle"}))
    found = {ExodusShape::point, 1};
  else
    return std::nullopt;
  return nodes < found.second ? std::nullopt : std::optional(found);
}

class ExodusReader {
 public:
  explicit ExodusReader(const Source& source) : file_(source), mesh_(source) {}

  MeshData read() {
    read_nodes();
    read_blocks();
    settle_quadrangles(mesh_);  // so that the triangles of a cell's side match
    read_side_sets();
    read_node_sets();
    tell_left_out();
    mesh_.names = {facet_ids_.take(), region_ids_.take(), segment_ids_.take(), vertex_ids_.take()};
    return std::move(mesh_);
  }

 private:
  static std::string numbered(const char* stem, std::size_t i) { return stem + std::to_string(i + 1); }

  void read_nodes() {
    std::array<std::vector<double>, 3> x;
    if (file_.has("coord")) {
      const auto shape = file_.shape("coord");
      const std::vector<double> all = file_.reals("coord");
      if (shape.size() != 2 || shape[0] > 3)
        file_.fail("coord", "expected one row for each of 1 to 3 directions");
      const auto count = static_cast<std::ptrdiff_t>(shape[1]);
      for (std::size_t k = 0; k < shape[0]; ++k)
        x[k].assign(all.begin() + static_cast<std::ptrdiff_t>(k) * count,
                    all.begin() + static_cast<std::ptrdiff_t>(k + 1) * count);
    } else if (file_.has("coordx")) {
      constexpr const char* kNames[] = {"coordx", "coordy", "coordz"};
      for (std::size_t k = 0; k < 3; ++k)
        if (file_.has(kNames[k])) x[k] = file_.reals(kNames[k]);
    } else {
      file_.fail("coord", "the file has no coordinates: it is no Exodus file");
    }
    plane_ = x[2].empty();
    if (x[0].size() >= no_entity) file_.fail("coord", "more nodes than 32 bits count");
    for (std::size_t i = 0; i < x[0].size(); ++i) {
      Point p{0, 0, 0};
      for (std::size_t k = 0; k < 3; ++k) {
        if (!x[k].empty() && x[k].size() != x[0].size())
          file_.fail("coord", "the directions have different numbers of nodes");
        if (!x[k].empty()) p[k] = x[k][i];
        if (!std::isfinite(p[k])) file_.fail("coord", "node " + std::to_string(i + 1) + " is not finite");
      }
      mesh_.vertices.push_back(p);
    }
  }

  /// The ids of blocks or sets, of which there are at least as many as arrays of these names.
  std::vector<int> ids_of(const std::string& property, const char* stem) {
    std::vector<std::int64_t> ids;
    if (file_.has(property)) ids = file_.integers(property);
    while (file_.has(numbered(stem, ids.size()))) ids.push_back(static_cast<std::int64_t>(ids.size()) + 1);
    std::vector<int> result;
    for (const std::int64_t id : ids) {
      if (id < std::numeric_limits<int>::min() || id > std::numeric_limits<int>::max())
        file_.fail(property, "the id " + std::to_string(id) + " does not fit 32 bits");
      result.push_back(static_cast<int>(id));
    }
    return result;
  }

  std::vector<std::string> names_of(const char* array, std::size_t count) {
    std::vector<std::string> names = file_.texts(array);
    names.resize(count);
    return names;
  }

  std::vector<std::int64_t> members(const std::string& array) {
    return file_.has(array) ? file_.integers(array) : std::vector<std::int64_t>();
  }

  void read_blocks() {
    const std::vector<int> ids = ids_of("eb_prop1", "connect");
    const std::vector<std::string> names = names_of("eb_names", ids.size());
    // Side sets, which tell where boundary conditions are, keep their numbers; shells share them by name.
    const std::vector<int> of_sides = ids_of("ss_prop1", "elem_ss");
    const std::vector<std::string> names_of_sides = names_of("ss_names", of_sides.size());
    for (std::size_t i = 0; i < of_sides.size(); ++i) {
      ids_of_side_sets_.insert(of_sides[i]);
      if (names_of_sides[i].empty())
        facet_ids_.set(of_sides[i], "");
      else
        facet_ids_.tell(of_sides[i], names_of_sides[i]);
    }
    for (std::size_t i = 0; i < ids.size(); ++i)
      if (file_.has(numbered("connect", i))) read_block(numbered("connect", i), ids[i], names[i]);
  }

  void read_block(const std::string& array, int id, const std::string& name) {
    const std::vector<std::uint64_t> shape = file_.shape(array);
    const std::string type = file_.text_attribute(array, "elem_type");
    const auto kind = shape.size() == 2 ? shape_of(type, static_cast<std::size_t>(shape[1])) : std::nullopt;
    if (!kind)
      file_.fail(array, "elements of type " + in_quotes(type) +
                            " are not read; split them into triangles or tetrahedra");
    ElementBlock block{array, kind->first, static_cast<std::size_t>(shape[1]), kind->second, elements_, {},
                       {},    {}};
    const std::vector<std::int64_t> nodes = file_.integers(array);
    block.count = nodes.size() / block.nodes_each;
    for (const std::int64_t node : nodes) {
      beat(file_.source().watch);
      if (node < 1 || static_cast<std::uint64_t>(node) > mesh_.vertices.size())
        file_.fail(array, "names node " + std::to_string(node) + ", but there are " +
                              std::to_string(mesh_.vertices.size()));
      block.nodes.push_back(static_cast<Index>(node - 1));
    }
    elements_ += block.count;
    const int tag = tag_of_block(block.shape, id, name);
    for (std::size_t i = 0; i < block.count; ++i) {
      block.entities.push_back(entities_so_far(block.shape));
      add(block, std::span(block.nodes).subspan(i * block.nodes_each, block.nodes_each), tag);
    }
    block.entities.push_back(entities_so_far(block.shape));
    if (block.shape == ExodusShape::point) mesh_.leave_out(block.count, "point elements", "point element");
    blocks_.push_back(std::move(block));
  }

  [[nodiscard]] Index entities_so_far(ExodusShape shape) const {
    return static_cast<Index>(shape == ExodusShape::tetrahedron || shape == ExodusShape::cell
                                  ? mesh_.tetrahedra.size()
                              : shape == ExodusShape::line ? mesh_.segments.size()
                                                           : mesh_.facets.size());
  }

  int tag_of_block(ExodusShape shape, int id, const std::string& name) {
    if (shape == ExodusShape::point) return 0;
    NamedIds& ids = shape == ExodusShape::tetrahedron || shape == ExodusShape::cell ? region_ids_
                    : shape == ExodusShape::line                                    ? segment_ids_
                                                                                    : facet_ids_;
    if (&ids == &facet_ids_ && ids_of_side_sets_.contains(id))
      return facet_ids_.id_of(name.empty() ? "block " + std::to_string(id) : name);
    ids.set(id, name);
    return ids.resolve(id);
  }

  void add(const ElementBlock& block, std::span<const Index> n, int tag) {
    const auto rest = n.subspan(block.corners);
    switch (block.shape) {
      case ExodusShape::point:
        return;
      case ExodusShape::line:
        if (n.size() == 3) return add_second_order(mesh_, Segment{n[0], n[1]}, n[2], tag);
        add_no_corners(mesh_, rest);
        return mesh_.add_segment({n[0], n[1]}, tag);
      case ExodusShape::triangle:
        if (n.size() == 6)
          return add_second_order(mesh_, Triangle{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, tag);
        add_no_corners(mesh_, rest);
        return mesh_.add_facet({n[0], n[1], n[2]}, tag);
      case ExodusShape::quadrangle:
        add_no_corners(mesh_, rest);
        return add_polygon(mesh_, n.first(4), tag,
                           [&](const std::string& reason) { file_.fail(block.name, reason); });
      case ExodusShape::tetrahedron: {
        const Tetrahedron corners{n[0], n[1], n[2], n[3]};
        if (n.size() == 10)
          return add_second_order(mesh_, corners, {n[4], n[5], n[6], n[7], n[8], n[9]}, tag);
        add_no_corners(mesh_, rest);
        return mesh_.add_tetrahedron(corners, tag);
      }
      case ExodusShape::cell:
        return add_cell(mesh_, n, block.corners, tag);
    }
  }

  void read_side_sets() {
    const std::vector<int> ids = ids_of("ss_prop1", "elem_ss");
    if (ids.empty()) return;
    const std::vector<std::string> names = names_of("ss_names", ids.size());
    FacetSets facets(mesh_);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const std::string array = numbered("elem_ss", i);
      const std::vector<std::int64_t> elements = members(array), sides = members(numbered("side_ss", i));
      if (elements.size() != sides.size()) file_.fail(array, "there are more elements than sides, or fewer");
      facet_ids_.set(ids[i], names[i]);
      const int marker = facet_ids_.resolve(ids[i]);
      for (std::size_t k = 0; k < elements.size(); ++k) {
        beat(file_.source().watch);
        read_side(facets, array, elements[k], sides[k], {marker, elements.size()});
      }
    }
    facets.finish();
  }

  void read_side(FacetSets& facets, const std::string& array, std::int64_t element, std::int64_t side,
                 const SetOfFile& set) {
    if (element < 1 || static_cast<std::uint64_t>(element) > elements_)
      file_.fail(array,
                 "names element " + std::to_string(element) + ", but there are " + std::to_string(elements_));
    const auto number = static_cast<std::size_t>(element - 1);
    const auto block =
        std::prev(std::upper_bound(blocks_.begin(), blocks_.end(), number,
                                   [](std::size_t n, const ElementBlock& b) { return n < b.first; }));
    const std::size_t i = number - block->first;
    const std::size_t of_element = sides_of(*block);
    if (side < 1 || static_cast<std::uint64_t>(side) > of_element)
      file_.fail(array, "names side " + std::to_string(side) + " of element " + std::to_string(element) +
                            ", which has " + std::to_string(of_element));
    const auto k = static_cast<std::size_t>(side - 1);
    const auto nodes = std::span(block->nodes).subspan(i * block->nodes_each, block->corners);
    switch (block->shape) {
      case ExodusShape::tetrahedron: {
        const std::size_t opposite = static_cast<std::size_t>(
            std::find(kExodusSideOpposite.begin(), kExodusSideOpposite.end(), k + 1) -
            kExodusSideOpposite.begin());
        const Index tetrahedron = block->entities[i];
        const Triangle facet = outward_face(mesh_.tetrahedra[tetrahedron], opposite);
        return facets.mark(facet, set, [&] { add_side(mesh_, tetrahedron, opposite, 0); });
      }
      case ExodusShape::cell: {
        const std::size_t of_cell = block->corners == 8   ? kExodusSidesOfHexahedron[k]
                                    : block->corners == 6 ? kExodusSidesOfPrism[k]
                                                          : kExodusSidesOfPyramid[k];
        for (const Triangle& facet : side_of_cell(nodes, of_cell))
          facets.mark(facet, set, [&] { mesh_.add_facet(facet); });
        return;
      }
      case ExodusShape::triangle:
      case ExodusShape::quadrangle:
        if (!plane_ && k < 2) {
          for (Index f = block->entities[i]; f < block->entities[i + 1]; ++f)
            facets.mark(mesh_.facets[f], set, [] {});
          return;
        }
        ++edges_;
        return;
      default:
        ++edges_;
    }
  }

  [[nodiscard]] std::size_t sides_of(const ElementBlock& block) const {
    switch (block.shape) {
      case ExodusShape::tetrahedron:
        return 4;
      case ExodusShape::cell:
        return block.corners == 8 ? 6 : 5;
      case ExodusShape::triangle:
      case ExodusShape::quadrangle:
        return block.corners + (plane_ ? 0 : 2);
      default:
        return 2;
    }
  }

  void read_node_sets() {
    const std::vector<int> ids = ids_of("ns_prop1", "node_ns");
    const std::vector<std::string> names = names_of("ns_names", ids.size());
    std::vector<VertexSet> sets;
    for (std::size_t i = 0; i < ids.size(); ++i) vertex_ids_.set(ids[i], names[i]);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      VertexSet set{vertex_ids_.resolve(ids[i]), {}};
      for (const std::int64_t node : members(numbered("node_ns", i))) {
        if (node < 1 || static_cast<std::uint64_t>(node) > mesh_.vertices.size())
          file_.fail(numbered("node_ns", i), "names node " + std::to_string(node) + ", but there are " +
                                                 std::to_string(mesh_.vertices.size()));
        set.vertices.push_back(static_cast<Index>(node - 1));
      }
      sets.push_back(std::move(set));
    }
    mark_vertices(mesh_, std::move(sets));
  }

  void tell_left_out() {
    mesh_.leave_out(edges_, "edges and ends in side sets", "edge or end in a side set");
    std::size_t count = 0;
    std::string variables;
    for (const char* array : {"name_nod_var", "name_elem_var", "name_glo_var"})
      for (const std::string& name : file_.texts(array))
        variables += (count++ > 0 ? ", " : "") + in_quotes(name);
    mesh_.leave_out(count, "variables (" + variables + ")", "variable (" + variables + ")");
    for (const char* array : {"ebconn1", "fbconn1"})
      if (file_.has(array)) mesh_.leave_out(1, "blocks of edges or faces", "list of edge or face blocks");
  }

  const NetcdfFile file_;
  MeshData mesh_;
  bool plane_ = false;  ///< the file has two dimensions
  std::vector<ElementBlock> blocks_;
  std::size_t elements_ = 0;
  std::set<int> ids_of_side_sets_;
  std::size_t edges_ = 0;  ///< in side sets
  NamedIds region_ids_{kRegionStem}, facet_ids_{kFacetStem}, segment_ids_{kSegmentStem},
      vertex_ids_{kVertexStem};
};

}  // namespace

MeshData read_exodus(const Source& source) { return ExodusReader(source).read(); }

}  // namespace holdfast::io
