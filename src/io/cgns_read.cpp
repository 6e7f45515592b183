// Reads CGNS in HDF5 (SIDS, https://cgns.github.io/CGNS_docs_current/sids/; its nodes in HDF5:
// filemap/hdf5): the unstructured zones of the first base. A section of elements is a region or a marker; a
// boundary condition gives its name to faces, or to vertices.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "io/cells.h"
#include "io/cgns.h"
#include "io/formats.h"
#include "io/hdf5_read.h"
#include "io/labels.h"
#include "io/mid_nodes.h"
#include "io/polygon.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

enum class CgnsShape { none, point, line, triangle, quadrangle, tetrahedron, cell, mixed, polygons };

struct CgnsType {
  CgnsShape shape = CgnsShape::none;
  std::size_t nodes = 0, corners = 0;
};

/// By the number of ElementType_t. The order of nodes in TETRA_10 and TRI_6 is that of VTK.
constexpr std::array<CgnsType, 24> kCgnsTypes{{{},
                                               {},
                                               {CgnsShape::point, 1, 1},
                                               {CgnsShape::line, 2, 2},
                                               {CgnsShape::line, 3, 2},
                                               {CgnsShape::triangle, 3, 3},
                                               {CgnsShape::triangle, 6, 3},
                                               {CgnsShape::quadrangle, 4, 4},
                                               {CgnsShape::quadrangle, 8, 4},
                                               {CgnsShape::quadrangle, 9, 4},
                                               {CgnsShape::tetrahedron, 4, 4},
                                               {CgnsShape::tetrahedron, 10, 4},
                                               {CgnsShape::cell, 5, 5},
                                               {CgnsShape::cell, 14, 5},
                                               {CgnsShape::cell, 6, 6},
                                               {CgnsShape::cell, 15, 6},
                                               {CgnsShape::cell, 18, 6},
                                               {CgnsShape::cell, 8, 8},
                                               {CgnsShape::cell, 20, 8},
                                               {CgnsShape::cell, 27, 8},
                                               {CgnsShape::mixed},
                                               {CgnsShape::cell, 13, 5},
                                               {CgnsShape::polygons},
                                               {}}};

/// Elements of a zone with consecutive numbers.
struct Section {
  std::string name;
  std::int64_t first = 1, last = 0;
  std::vector<Index> facets;  ///< by element, its first facet, and the end; empty without faces
};

class CgnsReader {
 public:
  explicit CgnsReader(const Source& source) : file_(source), mesh_(source) {}

  MeshData read() {
    const auto bases = children(file_.root(), "CGNSBase_t");
    if (bases.empty()) fail("", "no CGNS file: it has no base");
    mesh_.leave_out(bases.size() - 1, "bases after the first", "base after the first");
    const auto zones = children(bases.front().second, "Zone_t");
    if (zones.empty()) fail(bases.front().first, "the base has no zones");
    for (const auto& [name, zone] : zones) read_zone(name, zone, zones.size() > 1);
    mesh_.facet_markers = {};
    for (std::size_t f = 0; f < markers_.size(); ++f) mesh_.facet_markers.add(f, markers_[f]);
    for (std::size_t v = 0; v < vertex_markers_.size(); ++v) mesh_.vertex_markers.add(v, vertex_markers_[v]);
    mesh_.leave_out(solutions_, "solutions", "solution");
    mesh_.leave_out(of_cells_, "boundary conditions on cells or edges",
                    "boundary condition on cells or edges");
    mesh_.names = {facet_ids_.take(), region_ids_.take(), segment_ids_.take(), vertex_ids_.take()};
    // Sections whose faces all have boundary conditions.
    const std::set<int> used(markers_.begin(), markers_.end());
    std::erase_if(mesh_.names.facets, [&](const auto& name) { return !used.contains(name.first); });
    return std::move(mesh_);
  }

 private:
  using Node = std::pair<std::string, Hdf5File::Object>;

  [[noreturn]] void fail(const std::string& node, const std::string& reason) const {
    throw FileError(file_.source().path, node, reason);
  }

  /// The members of a node with this label, in the order of their names.
  [[nodiscard]] std::vector<Node> children(Hdf5File::Object node, std::string_view label) const {
    std::vector<Node> found;
    for (const auto& [name, member] : file_.links(node))
      if (file_.text_attribute(member, "label").value_or("") == label) {
        if (file_.text_attribute(member, "type").value_or("") == "LK")
          fail(name, "it is a link to another file, which is not read");
        found.emplace_back(name, member);
      }
    return found;
  }
  [[nodiscard]] std::optional<Hdf5File::Object> child(Hdf5File::Object node, const std::string& name) const {
    const auto members = file_.links(node);
    const auto found = members.find(name);
    return found == members.end() ? std::nullopt : std::optional(found->second);
  }
  [[nodiscard]] Hdf5File::Object data_of(const std::string& name, Hdf5File::Object node) const {
    const auto data = child(node, " data");
    if (!data) fail(name, "the node has no data");
    return *data;
  }
  /// Texts are arrays of bytes.
  [[nodiscard]] std::string text_of(const std::string& name, Hdf5File::Object node) const {
    std::string text;
    for (const std::int64_t c : file_.integers(data_of(name, node))) text += static_cast<char>(c);
    text = text.substr(0, text.find('\0'));
    return text.substr(0, text.find_last_not_of(' ') + 1);
  }

  void read_zone(const std::string& name, Hdf5File::Object zone, bool one_of_several) {
    const auto types = children(zone, "ZoneType_t");
    if (types.empty() || text_of(name, types.front().second) != "Unstructured")
      fail(name, "zones of structured grids are not read; save the mesh as unstructured");
    const std::size_t before = mesh_.vertices.size();
    read_coordinates(name, zone);
    const std::vector<Node> sections = in_file_order(children(zone, "Elements_t"));
    std::map<std::string, std::string> names;
    for (const auto& [section, node] : sections) names[section] = told(section, node);
    for (const auto& list : children(zone, "ZoneBC_t"))
      for (const auto& [condition, node] : children(list.second, "BC_t"))
        names["/" + condition] = told(condition, node);
    std::vector<Section> read;
    for (const auto& [section, node] : sections)
      read.push_back(
          read_section(section, node, before, names[section], one_of_several ? name : names[section]));
    settle_quadrangles(mesh_);
    for (const auto& list : children(zone, "ZoneBC_t"))
      for (const auto& [condition, node] : children(list.second, "BC_t"))
        read_condition(condition, node, names["/" + condition], read, before);
    solutions_ += children(zone, "FlowSolution_t").size();
  }

  /// Sections by their elements' numbers.
  [[nodiscard]] std::vector<Node> in_file_order(std::vector<Node> sections) const {
    std::vector<std::pair<std::int64_t, Node>> by_range;
    for (Node& section : sections) {
      const auto range = child(section.second, "ElementRange");
      const std::vector<std::int64_t> ends =
          range ? file_.integers(data_of(section.first, *range)) : std::vector<std::int64_t>();
      by_range.emplace_back(ends.empty() ? 0 : ends[0], std::move(section));
    }
    std::sort(by_range.begin(), by_range.end());
    sections.clear();
    for (auto& [first, section] : by_range) sections.push_back(std::move(section));
    return sections;
  }

  /// The name of a section or a boundary condition. Our files have it, with the id, in a descriptor, because
  /// a region and a marker of one name cannot both have sections of this name.
  std::string told(const std::string& node, Hdf5File::Object object) {
    const auto descriptor = child(object, kCgnsId);
    if (!descriptor) return node;
    const std::string text = text_of(node, *descriptor);
    const std::size_t first = text.find(' '), second = text.find(' ', first + 1);
    int id = 0;
    if (second == std::string::npos || second + 1 == text.size() ||
        std::from_chars(text.data() + first + 1, text.data() + second, id).ec != std::errc())
      return node;
    const std::string name = text.substr(second + 1);
    for (NamedIds* const ids : {&region_ids_, &facet_ids_, &segment_ids_})
      if (text.substr(0, first) == ids->stem()) ids->tell(id, name);
    return name;
  }

  void read_coordinates(const std::string& zone, Hdf5File::Object node) {
    const auto grids = children(node, "GridCoordinates_t");
    if (grids.empty()) fail(zone, "the zone has no coordinates");
    std::array<std::vector<double>, 3> x;
    constexpr const char* kNames[] = {"CoordinateX", "CoordinateY", "CoordinateZ"};
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto array = child(grids.front().second, kNames[k]))
        x[k] = file_.reals(data_of(kNames[k], *array));
    if (x[0].empty() || x[1].empty())
      fail(zone, "the zone has no CoordinateX and CoordinateY; other coordinates are not read");
    if (x[0].size() > no_entity - mesh_.vertices.size()) fail(zone, "more vertices than 32 bits count");
    for (std::size_t i = 0; i < x[0].size(); ++i) {
      Point p{0, 0, 0};
      for (std::size_t k = 0; k < 3; ++k) {
        if (x[k].empty()) continue;
        if (x[k].size() != x[0].size()) fail(zone, "the coordinates have different numbers of vertices");
        p[k] = x[k][i];
        if (!std::isfinite(p[k])) fail(zone, "vertex " + std::to_string(i + 1) + " is not finite");
      }
      mesh_.vertices.push_back(p);
    }
    vertex_markers_.resize(mesh_.vertices.size(), 0);
  }

  /// The vertex of the mesh with a number of the zone.
  [[nodiscard]] Index vertex(const std::string& node, std::int64_t number, std::size_t before) const {
    if (number < 1 || static_cast<std::uint64_t>(number) > mesh_.vertices.size() - before)
      fail(node, "names vertex " + std::to_string(number) + ", but there are " +
                     std::to_string(mesh_.vertices.size() - before));
    return static_cast<Index>(before + static_cast<std::size_t>(number - 1));
  }

  static const CgnsType* type_of(std::int64_t number) {
    const bool known = number >= 0 && static_cast<std::uint64_t>(number) < kCgnsTypes.size() &&
                       kCgnsTypes[static_cast<std::size_t>(number)].shape != CgnsShape::none;
    return known ? &kCgnsTypes[static_cast<std::size_t>(number)] : nullptr;
  }

  Section read_section(const std::string& name, Hdf5File::Object node, std::size_t before,
                       const std::string& marker, const std::string& region) {
    const std::vector<std::int64_t> kind = file_.integers(data_of(name, node));
    const auto range_node = child(node, "ElementRange"), nodes_node = child(node, "ElementConnectivity");
    if (kind.empty() || !range_node || !nodes_node) fail(name, "the section is not complete");
    const std::vector<std::int64_t> range = file_.integers(data_of(name, *range_node));
    const std::vector<std::int64_t> nodes = file_.integers(data_of(name, *nodes_node));
    const CgnsType* type = type_of(kind[0]);
    if (type == nullptr)
      fail(name, "elements of type " + std::to_string(kind[0]) +
                     " (polyhedra, or of higher order) are not read; split them into tetrahedra");
    if (range.size() != 2 || range[1] < range[0]) fail(name, "the range of its elements is wrong");
    Section section{name, range[0], range[1], {}};
    std::vector<std::int64_t> offsets;
    if (type->shape == CgnsShape::polygons) {
      const auto node_of = child(node, "ElementStartOffset");
      if (!node_of) fail(name, "polygons without ElementStartOffset (before CGNS 4) are not read");
      offsets = file_.integers(data_of(name, *node_of));
    }
    std::size_t at = 0, elements = 0;
    std::vector<Index> corners;
    TagsOfSection tags;
    const bool is_mixed = type->shape == CgnsShape::mixed;
    while (at < nodes.size()) {
      beat(file_.source().watch);
      CgnsType element = *type;
      if (is_mixed) {
        const CgnsType* of = type_of(nodes[at++]);
        if (of == nullptr || of->nodes == 0) fail(name, "a mixed element of a type that is not read");
        element = *of;
      } else if (type->shape == CgnsShape::polygons) {
        if (elements + 1 >= offsets.size() || offsets[elements + 1] <= offsets[elements])
          fail(name, "the offsets of its polygons are wrong");
        element.nodes = element.corners = static_cast<std::size_t>(offsets[elements + 1] - offsets[elements]);
      }
      if (element.nodes > nodes.size() - at) fail(name, "the last element is not whole");
      corners.clear();
      for (std::size_t k = 0; k < element.nodes; ++k) corners.push_back(vertex(name, nodes[at + k], before));
      at += element.nodes;
      ++elements;
      section.facets.push_back(static_cast<Index>(mesh_.facets.size()));
      add(name, element, corners, marker, region, tags);
    }
    section.facets.push_back(static_cast<Index>(mesh_.facets.size()));
    if (elements != static_cast<std::uint64_t>(section.last - section.first) + 1)
      fail(name, "has " + std::to_string(elements) + " elements, and a range of another number");
    return section;
  }

  /// The ids of a section's elements, found when they are first needed.
  struct TagsOfSection {
    std::optional<int> region, facet, segment;
  };
  static int id_of(std::optional<int>& tag, NamedIds& ids, const std::string& name) {
    if (!tag) tag = ids.id_of(name);
    return *tag;
  }

  void add(const std::string& section, const CgnsType& type, std::span<const Index> n,
           const std::string& marker, const std::string& region, TagsOfSection& tags) {
    const auto rest = n.subspan(type.corners);
    switch (type.shape) {
      case CgnsShape::line:
        if (n.size() == 3)
          return add_second_order(mesh_, Segment{n[0], n[1]}, n[2],
                                  id_of(tags.segment, segment_ids_, marker));
        return mesh_.add_segment({n[0], n[1]}, id_of(tags.segment, segment_ids_, marker));
      case CgnsShape::triangle:
        if (n.size() == 6)
          add_second_order(mesh_, Triangle{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, 0);
        else
          mesh_.add_facet({n[0], n[1], n[2]});
        return markers_.resize(mesh_.facets.size(), id_of(tags.facet, facet_ids_, marker));
      case CgnsShape::quadrangle:
      case CgnsShape::polygons:
        add_no_corners(mesh_, rest);
        add_polygon(mesh_, n.first(type.corners), 0,
                    [&](const std::string& reason) { fail(section, reason); });
        return markers_.resize(mesh_.facets.size(), id_of(tags.facet, facet_ids_, marker));
      case CgnsShape::tetrahedron: {
        const Tetrahedron corners{n[0], n[1], n[2], n[3]};
        const int id = id_of(tags.region, region_ids_, region);
        if (n.size() == 10) return add_second_order(mesh_, corners, {n[4], n[5], n[6], n[7], n[8], n[9]}, id);
        return mesh_.add_tetrahedron(corners, id);
      }
      case CgnsShape::cell:
        return add_cell(mesh_, n, type.corners, id_of(tags.region, region_ids_, region));
      default:
        return;
    }
  }

  void read_condition(const std::string& name, Hdf5File::Object node, const std::string& marker_name,
                      const std::vector<Section>& sections, std::size_t before) {
    std::string where = "Vertex";
    for (const auto& location : children(node, "GridLocation_t")) where = text_of(name, location.second);
    std::vector<std::int64_t> numbers;
    for (const char* list : {"PointList", "ElementList"})
      if (const auto found = child(node, list)) {
        numbers = file_.integers(data_of(name, *found));
        if (list[0] == 'E') where = "FaceCenter";
      }
    for (const char* range : {"PointRange", "ElementRange"})
      if (const auto found = child(node, range)) {
        const std::vector<std::int64_t> ends = file_.integers(data_of(name, *found));
        if (ends.size() != 2 || ends[1] < ends[0]) fail(name, "the range of the boundary condition is wrong");
        // No more than there are, whatever the range says.
        const auto most = static_cast<std::int64_t>(mesh_.vertices.size() + mesh_.facets.size() +
                                                    mesh_.tetrahedra.size() + mesh_.segments.size());
        if (ends[1] - ends[0] > most) fail(name, "its range is longer than the zone has elements");
        for (std::int64_t i = ends[0]; i <= ends[1]; ++i) numbers.push_back(i);
        if (range[0] == 'E') where = "FaceCenter";
      }
    if (where == "FaceCenter" || where == "IFaceCenter")
      return mark_faces(name, facet_ids_.id_of(marker_name), numbers, sections);
    if (where != "Vertex") {
      ++of_cells_;
      return;
    }
    const int marker = vertex_ids_.id_of(marker_name);
    for (const std::int64_t number : numbers) vertex_markers_[vertex(name, number, before)] = marker;
  }

  void mark_faces(const std::string& name, int marker, const std::vector<std::int64_t>& numbers,
                  const std::vector<Section>& sections) {
    for (const std::int64_t number : numbers) {
      const auto section = std::find_if(sections.begin(), sections.end(), [&](const Section& s) {
        return s.first <= number && number <= s.last;
      });
      if (section == sections.end())
        fail(name, "names element " + std::to_string(number) + ", which is in no section");
      const auto i = static_cast<std::size_t>(number - section->first);
      for (Index f = section->facets[i]; f < section->facets[i + 1]; ++f) markers_[f] = marker;
    }
  }

  const Hdf5File file_;
  MeshData mesh_;
  std::vector<int> markers_;         ///< by facet
  std::vector<int> vertex_markers_;  ///< by vertex
  std::size_t solutions_ = 0, of_cells_ = 0;
  NamedIds region_ids_{kRegionStem}, facet_ids_{kFacetStem}, segment_ids_{kSegmentStem},
      vertex_ids_{kVertexStem};
};

}  // namespace

MeshData read_cgns(const Source& source) {
  if (!is_hdf5(source.bytes))
    throw FileError(source.path, "byte 0",
                    "not CGNS in HDF5; `adf2hdf IN OUT` of the CGNS tools converts files of the older kind");
  return CgnsReader(source).read();
}

}  // namespace holdfast::io
