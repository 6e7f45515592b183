// Writes CGNS 3.4 in HDF5 (SIDS and its mapping to HDF5, https://cgns.github.io/CGNS_docs_current): one
// unstructured zone, a section of elements for each region, marker and segment marker, and a boundary
// condition on the faces of each marker.
#include <algorithm>
#include <list>
#include <set>

#include "io/cgns.h"
#include "io/formats.h"
#include "io/hdf5_write.h"
#include "io/mesh_sets.h"
#include "io/solver_text.h"

namespace holdfast::io {
namespace {

constexpr std::size_t kCgnsNameBytes = 32;
constexpr NameRule kCgnsNames{kCgnsNameBytes, "!#$%&'()*+,-:;<=>?@[]^_{|}~", true, false, false};

class CgnsWriter {
 public:
  CgnsWriter(const Volume& volume, Watch* watch)
      : volume_(volume),
        labels_(volume, kCgnsNames, kAnyId),
        watch_(watch),
        sides_(sides_of_facets(volume)) {}

  void write(AtomicWriter& out) {
    Hdf5Group root{"",
                   {{"name", std::string("HDF5 MotherNode")},
                    {"label", std::string("Root Node of HDF5 File")},
                    {"type", std::string("MT")}}};
    root.arrays.push_back(bytes(" format", "IEEE_LITTLE_32"));
    std::string version = "HDF5 Version 1.8.0";
    version.resize(32, '\0');
    root.arrays.push_back(bytes(" hdf5version", version));
    library_version_ = 3.4F;
    Hdf5Group library = node("CGNSLibraryVersion", "CGNSLibraryVersion_t", "R4");
    library.arrays.push_back({" data", Hdf5Type::float32, 1, 1, &library_version_});
    root.groups.push_back(std::move(library));
    Hdf5Group base = integers("Base", "CGNSBase_t", {3, 3});
    base.groups.push_back(zone());
    root.groups.push_back(std::move(base));
    write_hdf5(out, root);
  }

 private:
  static Hdf5Group node(const std::string& name, const std::string& label, const std::string& type) {
    return {name, {{"name", name}, {"label", label}, {"type", type}, {"flags", 1}}};
  }
  /// A text with the zero at its end.
  Hdf5Array bytes(const std::string& name, const std::string& text) {
    texts_.push_back(text);
    return {name, Hdf5Type::int8, text.size() + 1, 1, texts_.back().c_str()};
  }
  Hdf5Group text(const std::string& name, const std::string& label, const std::string& value) {
    Hdf5Group group = node(name, label, "C1");
    texts_.push_back(value);
    group.arrays.push_back({" data", Hdf5Type::int8, value.size(), 1, texts_.back().data()});
    return group;
  }
  Hdf5Group integers(const std::string& name, const std::string& label, std::vector<std::int32_t> values) {
    Hdf5Group group = node(name, label, "I4");
    integers_.push_back(std::move(values));
    group.arrays.push_back({" data", Hdf5Type::int32, integers_.back().size(), 1, integers_.back().data()});
    return group;
  }
  /// Numbers of vertices and elements, which may be beyond 32 bits.
  Hdf5Group numbers(const std::string& name, const std::string& label, std::vector<std::int64_t> values,
                    bool two_directions = false) {
    Hdf5Group group = node(name, label, "I8");
    numbers_.push_back(std::move(values));
    group.arrays.push_back(
        {" data", Hdf5Type::int64, numbers_.back().size(), 1, numbers_.back().data(), {}, two_directions});
    return group;
  }

  Hdf5Group zone() {
    Hdf5Group zone = numbers("Zone", "Zone_t",
                             {static_cast<std::int64_t>(node_count(volume_)),
                              static_cast<std::int64_t>(volume_.tetrahedra.size()), 0},
                             true);
    zone.groups.push_back(text("ZoneType", "ZoneType_t", "Unstructured"));
    Hdf5Group coordinates = node("GridCoordinates", "GridCoordinates_t", "MT");
    constexpr const char* kDirections[] = {"CoordinateX", "CoordinateY", "CoordinateZ"};
    for (std::size_t k = 0; k < 3; ++k) {
      std::vector<double>& x = reals_.emplace_back();
      for (std::size_t i = 0; i < node_count(volume_); ++i) x.push_back(io::node(volume_, i)[k]);
      Hdf5Group array = node(kDirections[k], "DataArray_t", "R8");
      array.arrays.push_back({" data", Hdf5Type::float64, x.size(), 1, x.data()});
      coordinates.groups.push_back(std::move(array));
    }
    zone.groups.push_back(std::move(coordinates));
    add_sections(zone);
    return zone;
  }

  void add_sections(Hdf5Group& zone) {
    const bool second = is_second_order(volume_);
    Hdf5Group conditions = node("ZoneBC", "ZoneBC_t", "MT");
    for (const auto& [id, members] : labels_.regions.sets())
      add_section(zone, labels_.regions, id, second ? 11 : 10, members,
                  [this](std::size_t t) { return tetrahedron_nodes(volume_, t, kVtkEdges); });
    for (const auto& [id, members] : labels_.facets.sets()) {
      const std::int64_t first = elements_ + 1;
      add_section(zone, labels_.facets, id, second ? 6 : 5, members,
                  [this](std::size_t f) { return facet_nodes(volume_, f); });
      if (!is_on_boundary(members)) continue;  // boundary conditions inside are none
      Hdf5Group condition = text(labels_.facets.names.at(id), "BC_t", "UserDefined");
      condition.groups.push_back(numbers("PointRange", "IndexRange_t", {first, elements_}, true));
      condition.groups.push_back(text("GridLocation", "GridLocation_t", "FaceCenter"));
      condition.groups.push_back(id_of(labels_.facets, id));
      conditions.groups.push_back(std::move(condition));
    }
    for (const auto& [id, members] : labels_.segments.sets())
      add_section(zone, labels_.segments, id, second ? 4 : 3, members,
                  [this](std::size_t i) { return segment_nodes(volume_, i); });
    if (!conditions.groups.empty()) zone.groups.push_back(std::move(conditions));
  }

  /// Whether any of some facets has tetrahedra at one side only, or at none.
  [[nodiscard]] bool is_on_boundary(const std::vector<std::size_t>& facets) const {
    return std::any_of(facets.begin(), facets.end(),
                       [&](std::size_t f) { return !sides_[f].behind || !sides_[f].front; });
  }

  Hdf5Group id_of(const Labels& labels, int id) {
    return text(kCgnsId, "Descriptor_t",
                std::string(labels.stem) + " " + std::to_string(id) + " " + labels.names.at(id));
  }

  template <typename NodesOf>
  void add_section(Hdf5Group& zone, const Labels& labels, int id, std::int32_t type,
                   const std::vector<std::size_t>& members, NodesOf nodes_of) {
    const std::int64_t first = elements_ + 1;
    elements_ += static_cast<std::int64_t>(members.size());
    std::vector<std::int64_t> nodes;
    for (const std::size_t m : members) {
      beat(watch_);
      for (const Index v : nodes_of(m)) nodes.push_back(std::int64_t{v} + 1);
    }
    Hdf5Group section = integers(free_name(labels.names.at(id)), "Elements_t", {type, 0});
    section.groups.push_back(numbers("ElementRange", "IndexRange_t", {first, elements_}));
    section.groups.push_back(numbers("ElementConnectivity", "DataArray_t", std::move(nodes)));
    section.groups.push_back(id_of(labels, id));
    zone.groups.push_back(std::move(section));
  }

  /// The name of a section, where a region and a marker may have the same.
  std::string free_name(std::string name) {
    if (taken_.insert(name).second) return name;
    for (int i = 2;; ++i) {
      const std::string end = "_" + std::to_string(i);
      std::string other = name.substr(0, kCgnsNameBytes - end.size()) + end;
      if (taken_.insert(other).second) return other;
    }
  }

  const Volume& volume_;
  SolverLabels labels_;
  Watch* watch_;
  std::vector<SidesOfFacet> sides_;
  float library_version_ = 0;
  std::int64_t elements_ = 0;
  std::set<std::string> taken_{"ZoneType", "GridCoordinates", "ZoneBC"};
  std::list<std::string> texts_;
  std::list<std::vector<std::int32_t>> integers_;
  std::list<std::vector<std::int64_t>> numbers_;
  std::list<std::vector<double>> reals_;
};

}  // namespace

void write_cgns(AtomicWriter& out, const Volume& volume) { CgnsWriter(volume, out.watch()).write(out); }

std::vector<Remark> not_in_cgns(const Volume& volume, const WriteOptions&) {
  std::vector<Remark> remarks;
  const SolverLabels labels(volume, kCgnsNames, kAnyId);
  for (const Labels* of : {&labels.regions, &labels.facets, &labels.segments}) tell(*of, ".cgns", remarks);
  tell_marked_vertices(volume, ".cgns", remarks);
  return remarks;
}

}  // namespace holdfast::io
