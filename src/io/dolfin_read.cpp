// Reads meshes of legacy DOLFIN, .xml (FEniCS 2019, "DOLFIN XML"): tetrahedra or triangles, with the markers
// in <domains> of cells, facets, edges and vertices. DOLFIN lists the corners of a cell by their numbers.
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include "io/dolfin.h"
#include "io/formats.h"
#include "io/numbered.h"
#include "io/text_reader.h"
#include "io/turn.h"
#include "io/xml_reader.h"
#include "numbers/sorted.h"

namespace holdfast::io {
namespace {

class DolfinReader {
 public:
  explicit DolfinReader(const Source& source) : source_(source), xml_(source), mesh_(source) {}

  MeshData read() {
    bool ended = false;
    while (const std::optional<XmlTag> tag = xml_.next()) {
      beat(source_.watch);
      if (!begun_ && tag->name != "dolfin")
        xml_.fail(*tag, "no mesh of DOLFIN: it does not begin with <dolfin>");
      begun_ = true;
      ended = ended || (tag->closing && tag->name == "dolfin");
      if (!tag->closing) use(*tag);
    }
    if (!ended)
      throw FileError(source_.path, "", "does not end with </dolfin>; it is truncated or not DOLFIN's");
    require_once(nodes_, "vertex");
    require_once(numbers_, "cell");
    if (mesh_.vertices.empty()) throw FileError(source_.path, "", "the file has no mesh");
    for (const Cell& cell : cells_) add_cell_of(cell);
    turn_to_vtk(mesh_);
    add_values();
    mesh_.leave_out(functions_, "functions on the mesh", "function on the mesh");
    return std::move(mesh_);
  }

 private:
  struct Cell {
    std::array<std::uint64_t, 4> nodes;
    std::size_t position;
  };
  struct Value {
    std::size_t dimension;
    std::uint64_t cell, entity, value;
    std::size_t position;
  };

  void use(const XmlTag& tag) {
    const std::string& name = tag.name;
    if (name == "mesh") {
      const std::string type = tag.attribute("celltype");
      corners_ = type == "tetrahedron" ? 4 : type == "triangle" ? 3 : 0;
      if (corners_ == 0) xml_.fail(tag, "cells of the type " + in_quotes(type) + " are not read");
    } else if (name == "vertex") {
      nodes_.add(integer(tag, "index"));
      Point point{};
      constexpr const char* kAxes[] = {"x", "y", "z"};
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (axis < 2 || !tag.attribute(kAxes[axis]).empty()) point[axis] = xml_.real(tag, kAxes[axis]);
      mesh_.vertices.push_back(point);
    } else if (name == "tetrahedron" || name == "triangle") {
      if (name.size() != (corners_ == 4 ? 11U : 8U))
        xml_.fail(tag, "a <" + name + "> among cells of another type");
      numbers_.add(integer(tag, "index"));
      Cell cell{{}, tag.position};
      constexpr const char* kCorners[] = {"v0", "v1", "v2", "v3"};
      for (std::size_t k = 0; k < corners_; ++k) cell.nodes[k] = xml_.number(tag, kCorners[k]);
      cells_.push_back(cell);
    } else if (name == "domains") {
      in_domains_ = !tag.empty;  // nothing follows it in a mesh
    } else if (name == "mesh_value_collection" || name == "mesh_function" || name == "meshfunction") {
      if (!in_domains_) ++functions_;
      dimension_ = static_cast<std::size_t>(std::min<std::uint64_t>(xml_.number(tag, "dim"), 4));
    } else if (name == "value" && in_domains_) {
      values_.push_back({dimension_, xml_.number(tag, "cell_index"), xml_.number(tag, "local_entity"),
                         xml_.number(tag, "value"), tag.position});
    }
  }

  std::int64_t integer(const XmlTag& tag, std::string_view key) const {
    const std::uint64_t value = xml_.number(tag, key);
    if (value >= no_entity)
      fail_at(tag.position, "the index " + std::to_string(value) + " is beyond 32 bits");
    return static_cast<std::int64_t>(value);
  }

  [[noreturn]] void fail_at(std::size_t position, const std::string& reason) const {
    XmlTag tag;
    tag.position = position;
    xml_.fail(tag, reason);
  }

  void require_once(Numbered& numbers, const std::string& what) const {
    if (const auto twice = numbers.finish())
      throw FileError(source_.path, "", "the " + what + " " + std::to_string(*twice) + " occurs twice");
  }

  void add_cell_of(const Cell& cell) {
    std::array<Index, 4> n{};
    for (std::size_t k = 0; k < corners_; ++k) {
      const std::optional<Index> found =
          cell.nodes[k] < no_entity ? nodes_.find(static_cast<std::int64_t>(cell.nodes[k])) : std::nullopt;
      if (!found) fail_at(cell.position, "the vertex " + std::to_string(cell.nodes[k]) + " does not exist");
      n[k] = *found;
    }
    listed_.push_back(n);
    if (corners_ == 4)
      mesh_.add_tetrahedron({n[0], n[1], n[2], n[3]});
    else
      mesh_.add_facet({n[0], n[1], n[2]});
  }

  void add_values() {
    std::vector<int> of_cells(cells_.size(), 0), of_vertices(mesh_.vertices.size(), 0);
    std::map<Triangle, int> facets;  // by ascending corners
    std::map<Segment, int> edges;
    for (const Value& value : values_) {
      beat(source_.watch);
      if (value.value > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
        fail_at(value.position, "the value " + std::to_string(value.value) + " is beyond 32 bits");
      const auto marker = static_cast<int>(value.value);
      const std::optional<Index> cell =
          value.cell < no_entity ? numbers_.find(static_cast<std::int64_t>(value.cell)) : std::nullopt;
      if (!cell) fail_at(value.position, "the cell " + std::to_string(value.cell) + " does not exist");
      const auto entity = static_cast<std::size_t>(value.entity);
      const std::array<Index, 4>& n = listed_[*cell];
      if (value.dimension + 1 == corners_) {
        of_cells[*cell] = marker;
        continue;
      }
      const std::size_t most = value.dimension == 1 ? (corners_ == 4 ? 6 : 3) : corners_;
      if (value.dimension + 1 > corners_ || entity >= most)
        fail_at(value.position, "a cell has no entity " + std::to_string(value.entity) + " of dimension " +
                                    std::to_string(value.dimension));
      if (value.dimension == 0)
        of_vertices[n[entity]] = marker;
      else if (value.dimension == 2)
        add_facet(*cell, n[entity], marker, facets);
      else
        add_edge(n, entity, marker, edges);
    }
    for (std::size_t c = 0; c < of_cells.size(); ++c)
      (corners_ == 4 ? mesh_.regions : mesh_.facet_markers).add(c, of_cells[c]);
    for (std::size_t v = 0; v < of_vertices.size(); ++v) mesh_.vertex_markers.add(v, of_vertices[v]);
  }

  /// The face opposite a vertex, once.
  void add_facet(Index cell, Index opposite, int marker, std::map<Triangle, int>& known) {
    const Tetrahedron& corners = mesh_.tetrahedra[cell];
    const auto i =
        static_cast<std::size_t>(std::find(corners.begin(), corners.end(), opposite) - corners.begin());
    const Triangle facet = outward_face(corners, i);
    if (known.emplace(ascending(facet), marker).second) mesh_.add_facet(facet, marker);
  }

  void add_edge(const std::array<Index, 4>& n, std::size_t entity, int marker,
                std::map<Segment, int>& known) {
    const auto& [a, b] = corners_ == 4 ? kDolfinEdges[entity] : kDolfinEdgesOfTriangle[entity];
    const Segment edge{n[a], n[b]};
    if (known.emplace(ascending(edge), marker).second) mesh_.add_segment(edge, marker);
  }

  Source source_;
  XmlReader xml_;
  MeshData mesh_;
  bool begun_ = false, in_domains_ = false;
  std::size_t corners_ = 0, dimension_ = 0, functions_ = 0;
  Numbered nodes_, numbers_;
  std::vector<Cell> cells_;
  std::vector<std::array<Index, 4>> listed_;  ///< corners of the cells, as the file lists them
  std::vector<Value> values_;
};

}  // namespace

MeshData read_dolfin(const Source& source) { return DolfinReader(source).read(); }

}  // namespace holdfast::io
