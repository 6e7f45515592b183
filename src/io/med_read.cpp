// Reads MED 2.3 to 4.1 (Salome, code_aster, meshio): the first mesh of a file, with its groups. Where groups
// overlap, the smaller one counts.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <span>

#include "io/cells.h"
#include "io/hdf5_read.h"
#include "io/labels.h"
#include "io/med.h"
#include "io/mid_nodes.h"
#include "io/polygon.h"
#include "io/text_reader.h"
#include "io/turn.h"

namespace holdfast::io {
namespace {

struct Family {
  std::string name;
  std::vector<std::string> groups;
};

/// How the elements of a type are read.
struct MedType {
  std::string_view name;
  std::size_t nodes;
  enum class Kind { tetrahedron, cell, triangle, quadrangle, segment } kind;
};
constexpr MedType kMedTypes[] = {
    {"TE4", 4, MedType::Kind::tetrahedron}, {"T10", 10, MedType::Kind::tetrahedron},
    {"TR3", 3, MedType::Kind::triangle},    {"TR6", 6, MedType::Kind::triangle},
    {"TR7", 7, MedType::Kind::triangle},    {"QU4", 4, MedType::Kind::quadrangle},
    {"QU8", 8, MedType::Kind::quadrangle},  {"QU9", 9, MedType::Kind::quadrangle},
    {"SE2", 2, MedType::Kind::segment},     {"SE3", 3, MedType::Kind::segment},
    {"SE4", 4, MedType::Kind::segment},     {"HE8", 8, MedType::Kind::cell},
    {"H20", 20, MedType::Kind::cell},       {"H27", 27, MedType::Kind::cell},
    {"PE6", 6, MedType::Kind::cell},        {"P15", 15, MedType::Kind::cell},
    {"P18", 18, MedType::Kind::cell},       {"PY5", 5, MedType::Kind::cell},
    {"P13", 13, MedType::Kind::cell},
};

class MedReader {
 public:
  explicit MedReader(const Source& source) : file_(source), mesh_(source) {}

  MeshData read() {
    const auto meshes = file_.find(file_.root(), kMedMeshes);
    if (!meshes) fail("this HDF5 file is no MED file: it has no group ENS_MAA");
    const auto all = file_.links(*meshes);
    if (all.empty()) fail("the file holds no mesh");
    const auto& [name, mesh] = *all.begin();
    mesh_.leave_out(all.size() - 1, "meshes besides " + in_quotes(name), "mesh besides " + in_quotes(name));
    if (file_.integer_attribute(mesh, "TYP").value_or(0) == 1) fail("structured meshes are not read");
    auto parts = file_.links(mesh);
    if (!parts.contains("NOE") && !parts.empty()) {  // since version 3, by time
      mesh_.leave_out(parts.size() - 1, "later states of the mesh", "later state of the mesh");
      parts = file_.links(parts.begin()->second);
    }
    if (!parts.contains("NOE")) fail("the mesh has no nodes");
    read_families(name);
    read_nodes(parts.at("NOE"), mesh);
    if (parts.contains("MAI")) read_elements(parts.at("MAI"));
    turn_if_all_are_turned(mesh_,
                           "all tetrahedra are oriented as in VTK, not as in MED, and are read that way");
    mesh_.names = {facets_.take(), regions_.take(), segments_.take(), vertices_.take()};
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason, const std::string& where = {}) const {
    throw FileError(file_.source().path, where, reason);
  }

  void read_families(const std::string& mesh) {
    const auto all = file_.find(file_.root(), kMedFamilies);
    if (!all) return;
    const auto of_meshes = file_.links(*all);
    const auto found = of_meshes.find(mesh);
    if (found == of_meshes.end()) return;
    for (const auto& [name, object] : file_.links(found->second)) {
      if (file_.integer_attribute(object, "NUM")) {  // before version 3, and the family of no groups
        read_family(name, object);
        continue;
      }
      for (const auto& [inner, family] : file_.links(object)) read_family(inner, family);
    }
    // Ids contained in names of families come first, so that nothing else takes their number.
    for (const auto& [number, family] : families_)
      for (NamedIds* const ids : {&regions_, &facets_, &segments_, &vertices_})
        if (const auto id = id_of_default_name(ids->stem(), family.name); id && !family.groups.empty())
          ids->tell(*id, family.groups.front());
  }

  void read_family(const std::string& name, Hdf5File::Object object) {
    const auto number = file_.integer_attribute(object, "NUM");
    if (!number) return;
    Family& family = families_[*number];
    family.name = name;
    const auto members = file_.links(object);
    const auto groups = members.find("GRO");
    if (groups == members.end()) return;
    const auto arrays = file_.links(groups->second);
    if (const auto names = arrays.find("NOM"); names != arrays.end())
      family.groups = file_.texts(names->second);
  }

  [[nodiscard]] std::vector<std::int64_t> families_of(const std::map<std::string, Hdf5File::Object>& arrays,
                                                      std::size_t count, const std::string& what) const {
    const auto found = arrays.find("FAM");
    if (found == arrays.end()) return std::vector<std::int64_t>(count, 0);
    std::vector<std::int64_t> families = file_.integers(found->second);
    if (families.size() != count)
      fail("there are " + std::to_string(families.size()) + " families for " + std::to_string(count), what);
    return families;
  }

  /// The id of each used family, from its smallest group.
  [[nodiscard]] std::map<std::int64_t, int> ids_of(const std::vector<std::int64_t>& families, NamedIds& ids) {
    std::map<std::int64_t, std::size_t> members;
    for (const std::int64_t family : families) ++members[family];
    std::map<std::string, std::size_t> sizes;
    for (const auto& [number, count] : members)
      if (const auto found = families_.find(number); found != families_.end())
        for (const std::string& group : found->second.groups) sizes[group] += count;
    std::map<std::int64_t, int> result;
    for (const auto& [number, count] : members) {
      result[number] = 0;
      const auto found = families_.find(number);
      if (number == 0 || found == families_.end()) continue;
      const std::vector<std::string>& groups = found->second.groups;
      const auto least = std::min_element(groups.begin(), groups.end(),
                                          [&](const auto& a, const auto& b) { return sizes[a] < sizes[b]; });
      result[number] = ids.id_of(least == groups.end() ? found->second.name : *least);
      if (groups.size() > 1) overlaps_ += groups.size() - 1;
    }
    return result;
  }

  void read_nodes(Hdf5File::Object nodes, Hdf5File::Object mesh) {
    const auto arrays = file_.links(nodes);
    const auto found = arrays.find("COO");
    if (found == arrays.end()) fail("the mesh has no coordinates");
    const std::vector<double> values = file_.reals(found->second);
    const auto dimension = static_cast<std::size_t>(
        std::clamp<std::int64_t>(file_.integer_attribute(mesh, "ESP").value_or(3), 1, 3));
    if (values.size() % dimension != 0) fail("the last node's coordinates are not whole", "COO");
    const std::size_t count = values.size() / dimension;
    if (count >= no_entity) fail("more nodes than 32 bits count", "COO");
    const std::vector<std::int64_t> families = families_of(arrays, count, "nodes");
    const std::map<std::int64_t, int> ids = ids_of(families, vertices_);
    for (std::size_t i = 0; i < count; ++i) {
      Point p{0, 0, 0};
      for (std::size_t k = 0; k < dimension; ++k) p[k] = values[k * count + i];
      if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
        fail("a coordinate is not finite", "node " + std::to_string(i + 1));
      mesh_.add_vertex(p, ids.at(families[i]));
    }
  }

  void read_elements(Hdf5File::Object elements) {
    const auto all = file_.links(elements);
    for (const auto& link : all) {
      const std::string& name = link.first;
      const auto type = std::find_if(std::begin(kMedTypes), std::end(kMedTypes),
                                     [&](const MedType& t) { return t.name == name; });
      if (type != std::end(kMedTypes)) continue;
      if (name != "PO1")
        fail("elements of type " + in_quotes(name) +
             " are not read; split them into triangles or tetrahedra");
      mesh_.leave_out(1, "point elements", "list of point elements");
    }
    for (const MedType& type : kMedTypes)  // in this order, not that of the names
      if (const auto found = all.find(std::string(type.name)); found != all.end())
        read_type(type, found->second);
    mesh_.leave_out(overlaps_, "groups of families that are in smaller groups",
                    "group of a family that is in a smaller group");
  }

  void read_type(const MedType& type, Hdf5File::Object object) {
    using Kind = MedType::Kind;
    const std::string name(type.name);
    const auto arrays = file_.links(object);
    const auto found = arrays.find("NOD");
    if (found == arrays.end()) fail("the elements have no nodes", name);
    const std::vector<std::int64_t> nodes = file_.integers(found->second);
    if (nodes.size() % type.nodes != 0) fail("the last element is not whole", name);
    const std::size_t count = nodes.size() / type.nodes;
    const std::vector<std::int64_t> families = families_of(arrays, count, name);
    NamedIds& ids = type.kind == Kind::tetrahedron || type.kind == Kind::cell ? regions_
                    : type.kind == Kind::segment                              ? segments_
                                                                              : facets_;
    const std::map<std::int64_t, int> id_of_family = ids_of(families, ids);
    std::vector<Index> n(type.nodes);
    for (std::size_t i = 0; i < count; ++i) {
      beat(file_.source().watch);
      for (std::size_t k = 0; k < type.nodes; ++k) {
        const std::int64_t node = nodes[k * count + i];
        if (node < 1 || static_cast<std::uint64_t>(node) > mesh_.vertices.size())
          fail("names node " + std::to_string(node) + ", but there are " +
                   std::to_string(mesh_.vertices.size()),
               name + " element " + std::to_string(i + 1));
        n[k] = static_cast<Index>(node - 1);
      }
      add(type, n, id_of_family.at(families[i]), i);
    }
  }

  void add(const MedType& type, const std::vector<Index>& n, int id, std::size_t i) {
    using Kind = MedType::Kind;
    switch (type.kind) {
      case Kind::tetrahedron: {
        const auto at = [&](std::size_t k) { return n[kMedTetrahedron[k]]; };
        const Tetrahedron corners{at(0), at(1), at(2), at(3)};
        if (type.nodes == 4) return mesh_.add_tetrahedron(corners, id);
        return add_second_order(mesh_, corners, {at(4), at(5), at(6), at(7), at(8), at(9)}, id);
      }
      case Kind::cell:
        return add_cell(mesh_, n, corners_of_cell(type.nodes), id);
      case Kind::triangle:
        if (type.nodes == 7) add_no_corners(mesh_, std::span(n).subspan(3));
        if (type.nodes != 6) return mesh_.add_facet({n[0], n[1], n[2]}, id);
        return add_second_order(mesh_, Triangle{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, id);
      case Kind::quadrangle:
        add_no_corners(mesh_, std::span(n).subspan(4));
        return add_polygon(mesh_, std::span(n).first(4), id, [&](const std::string& reason) {
          fail(reason, std::string(type.name) + " element " + std::to_string(i + 1));
        });
      case Kind::segment:
        if (type.nodes == 4) add_no_corners(mesh_, std::span(n).subspan(2));
        if (type.nodes != 3) return mesh_.add_segment({n[0], n[1]}, id);
        return add_second_order(mesh_, Segment{n[0], n[1]}, n[2], id);
    }
  }

  const Hdf5File file_;
  MeshData mesh_;
  std::map<std::int64_t, Family> families_;
  NamedIds regions_{kRegionStem}, facets_{kFacetStem}, segments_{kSegmentStem}, vertices_{kVertexStem};
  std::size_t overlaps_ = 0;
};

}  // namespace

MeshData read_med(const Source& source) { return MedReader(source).read(); }

}  // namespace holdfast::io
