// Writes MED 4.1 (Salome, code_aster): one mesh in HDF5, with a family for each region, marker, segment
// marker and vertex marker. A family's name contains the id, and its group has the name.
#include <list>
#include <map>

#include "io/hdf5_write.h"
#include "io/med.h"
#include "io/solver_text.h"

namespace holdfast::io {
namespace {

constexpr std::size_t kMedNameBytes = 80;
constexpr NameRule kMedNames{kMedNameBytes, "!#$%&'()*+,-./:;<=>?@[]^_{|}~", true, true, false};

struct MedLabels {
  Labels regions, facets, segments, vertices;
  explicit MedLabels(const Volume& volume) {
    const SolverLabels labels(volume, kMedNames, kAnyId);
    regions = labels.regions;
    facets = labels.facets;
    segments = labels.segments;
    vertices = labels_of(kVertexStem, volume.vertex_markers,
                         volume.vertex_markers.empty() ? 0 : volume.vertices.size(), volume.names.vertices,
                         kMedNames, kAnyId);
  }
};

/// The families of one kind of entity: numbers are positive for nodes and negative for elements.
struct Families {
  std::map<int, std::int32_t> number_of;  ///< by id
};

struct MedElement {
  std::string type;
  std::size_t nodes_each = 0;
  std::vector<std::int64_t> nodes;  ///< the first node of all elements, then the second of all, ...
  std::vector<std::int32_t> families;
};

std::vector<Hdf5Attribute> profile(std::vector<Hdf5Attribute> attributes) {
  attributes.push_back({"PFL", std::string("MED_NO_PROFILE_INTERNAL")});
  return attributes;
}

class MedWriter {
 public:
  explicit MedWriter(const Volume& volume, Watch* watch) : volume_(volume), labels_(volume), watch_(watch) {}

  void write(AtomicWriter& out) {
    Hdf5Group families{"mesh"};
    families.groups.push_back({"FAMILLE_ZERO", {{"NUM", 0}}});
    Hdf5Group of_elements{"ELEME"}, of_nodes{"NOEUD"};
    std::int32_t next = 0;
    for (auto [labels, numbers] :
         {std::pair{&labels_.regions, &regions_}, std::pair{&labels_.facets, &facets_},
          std::pair{&labels_.segments, &segments_}})
      for (const auto& [id, name] : labels->names) {
        numbers->number_of[id] = --next;
        of_elements.groups.push_back(family(labels->stem, id, next, name));
      }
    next = 0;
    for (const auto& [id, name] : labels_.vertices.names) {
      if (id == 0 && !volume_.names.vertices.contains(0)) continue;  // no family, as for most vertices
      vertices_.number_of[id] = ++next;
      of_nodes.groups.push_back(family(labels_.vertices.stem, id, next, name));
    }
    if (!of_elements.groups.empty()) families.groups.push_back(std::move(of_elements));
    if (!of_nodes.groups.empty()) families.groups.push_back(std::move(of_nodes));
    make_elements();
    const Hdf5Group root{"",
                         {},
                         {},
                         {{"INFOS_GENERALES", {{"MAJ", 4}, {"MIN", 1}, {"REL", 0}}},
                          {std::string(kMedMeshes), {}, {}, {mesh()}},
                          {std::string(kMedFamilies), {}, {}, {std::move(families)}}}};
    write_hdf5(out, root);
  }

 private:
  /// A family named by its id, like ids without a name, so that it is found again; its group has the name.
  Hdf5Group family(std::string_view stem, int id, std::int32_t number, const std::string& name) {
    std::string& text = group_names_.emplace_back(name);
    text.resize(kMedNameBytes, '\0');
    return {std::string(stem) + '_' + std::to_string(id),
            {{"NUM", number}},
            {},
            {{"GRO", {{"NBR", 1}}, {{"NOM", Hdf5Type::text80, 1, 1, text.data()}}}}};
  }

  static std::int32_t family_of(const Families& families, const Labels& labels, std::size_t i) {
    const auto found = families.number_of.find(labels.ids[i]);
    return found == families.number_of.end() ? 0 : found->second;
  }

  template <typename NodesOf>
  void add_elements(std::string_view first, std::string_view second, std::size_t count, const Labels& labels,
                    const Families& families, NodesOf&& nodes_of) {
    if (count == 0) return;
    MedElement& element = elements_.emplace_back();
    element.type = is_second_order(volume_) ? second : first;
    for (std::size_t i = 0; i < count; ++i) {
      beat(watch_);
      const Nodes nodes = nodes_of(i);
      element.nodes_each = nodes.count;
      if (element.nodes.empty()) element.nodes.resize(count * nodes.count);
      for (std::size_t k = 0; k < nodes.count; ++k)
        element.nodes[k * count + i] = std::int64_t{nodes.of[k]} + 1;
      element.families.push_back(family_of(families, labels, i));
    }
  }

  void make_elements() {
    elements_.reserve(3);
    add_elements("TE4", "T10", volume_.tetrahedra.size(), labels_.regions, regions_, [&](std::size_t i) {
      const Nodes nodes = tetrahedron_nodes(volume_, i, kVtkEdges);
      Nodes turned = nodes;
      for (std::size_t k = 0; k < nodes.count; ++k) turned.of[k] = nodes.of[kMedTetrahedron[k]];
      return turned;
    });
    add_elements("TR3", "TR6", volume_.facets.size(), labels_.facets, facets_,
                 [&](std::size_t i) { return facet_nodes(volume_, i); });
    add_elements("SE2", "SE3", volume_.segments.size(), labels_.segments, segments_,
                 [&](std::size_t i) { return segment_nodes(volume_, i); });
    const std::size_t count = node_count(volume_);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < count; ++i) coordinates_.push_back(node(volume_, i)[k]);
    if (vertices_.number_of.empty()) return;
    for (std::size_t i = 0; i < volume_.vertices.size(); ++i)
      node_families_.push_back(family_of(vertices_, labels_.vertices, i));
    node_families_.resize(count, 0);
  }

  Hdf5Group mesh() {
    const auto counted = [](std::size_t count) {
      return std::vector<Hdf5Attribute>{{"CGT", 1}, {"NBR", static_cast<std::int32_t>(count)}};
    };
    const std::size_t points = node_count(volume_);
    Hdf5Group nodes{"NOE", profile({{"CGT", 1}, {"CGS", 1}})};
    nodes.arrays.push_back(
        {"COO", Hdf5Type::float64, coordinates_.size(), 1, coordinates_.data(), counted(points)});
    if (!node_families_.empty())
      nodes.arrays.push_back({"FAM", Hdf5Type::int32, points, 1, node_families_.data(), counted(points)});
    Hdf5Group elements{"MAI", {{"CGT", 1}}};
    for (const MedElement& e : elements_) {
      const std::size_t count = e.families.size();
      elements.groups.push_back({e.type,
                                 profile({{"CGT", 1}, {"CGS", 1}}),
                                 {{"NOD", Hdf5Type::int64, e.nodes.size(), 1, e.nodes.data(), counted(count)},
                                  {"FAM", Hdf5Type::int32, count, 1, e.families.data(), counted(count)}}});
    }
    Hdf5Group step{std::string(kMedStep),
                   {{"CGT", 1}, {"NDT", -1}, {"NOR", -1}, {"NXT", -1}, {"NXI", -1}, {"PDT", -1.0}}};
    step.groups = {std::move(nodes), std::move(elements)};
    constexpr std::int32_t kDimension = 3, kSortedByStep = 0, kUnstructured = 0, kCartesian = 0;
    std::string axes, units(48, ' ');
    for (const char axis : {'X', 'Y', 'Z'}) axes += axis + std::string(15, ' ');
    return {"mesh",
            {{"DIM", kDimension},
             {"ESP", kDimension},
             {"REP", kCartesian},
             {"UNT", std::string()},
             {"UNI", units},
             {"SRT", kSortedByStep},
             {"NOM", axes},
             {"DES", std::string("mesh by Holdfast")},
             {"TYP", kUnstructured},
             {"NXT", -1},
             {"NXI", -1}},
            {},
            {std::move(step)}};
  }

  const Volume& volume_;
  const MedLabels labels_;
  Watch* const watch_;
  Families regions_, facets_, segments_, vertices_;
  std::list<std::string> group_names_;  ///< a list, because its addresses are stable
  std::vector<MedElement> elements_;
  std::vector<double> coordinates_;
  std::vector<std::int32_t> node_families_;
};

}  // namespace

void write_med(AtomicWriter& out, const Volume& volume) { MedWriter(volume, out.watch()).write(out); }

std::vector<Remark> not_in_med(const Volume& volume, const WriteOptions&) {
  const MedLabels labels(volume);
  std::vector<Remark> remarks;
  for (const Labels* of : {&labels.regions, &labels.facets, &labels.segments, &labels.vertices})
    tell(*of, ".med", remarks);
  return remarks;
}

}  // namespace holdfast::io
