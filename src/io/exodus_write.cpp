// Writes Exodus II: each region as a block of tetrahedra, the facets of each marker as a side set, and the
// vertices of each marker as a node set. Facets with no tetrahedron at either side are blocks of triangles.
#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "io/exodus.h"
#include "io/formats.h"
#include "io/mesh_sets.h"
#include "io/netcdf_write.h"
#include "io/solver_text.h"

namespace holdfast::io {
namespace {

/// Programs reserve 32 characters or as many as the file says; 255 are the most that the library can say.
constexpr std::size_t kExodusNameBytes = 255;
constexpr NameRule kExodusNames{kExodusNameBytes, "!#$%&'()*+,-./:;<=>?@[]^_{|}~", true, true, false};
constexpr IdRule kExodusIds{};

struct ExodusLabels : SolverLabels {
  Labels vertices;
  explicit ExodusLabels(const Volume& volume)
      : SolverLabels(volume, kExodusNames, kExodusIds),
        vertices(labels_of(kVertexStem, volume.vertex_markers,
                           volume.vertex_markers.empty() ? 0 : volume.vertices.size(), volume.names.vertices,
                           kExodusNames, kExodusIds)) {}
};

class ExodusWriter {
 public:
  explicit ExodusWriter(const Volume& volume, Watch* watch)
      : volume_(volume), labels_(volume), watch_(watch), sides_(sides_of_facets(volume)) {}

  void write(AtomicWriter& out) {
    add_start();
    add_blocks();
    add_side_sets();
    add_node_sets();
    content_.write(out);
  }

 private:
  void dimension(const std::string& name, std::uint64_t extent) {
    content_.dimensions.emplace_back(name, extent);
  }
  void integers(const std::string& name, const std::string& of, std::vector<std::int32_t> values,
                std::vector<NetcdfAttribute> attributes = {}) {
    content_.arrays.push_back({name,
                               NetcdfKind::integer,
                               {of},
                               std::move(attributes),
                               [values = std::move(values)](NetcdfValues& out) {
                                 for (const std::int32_t value : values) out.add(value);
                               }});
  }
  void texts(const std::string& name, const std::string& of, std::vector<std::string> rows) {
    content_.arrays.push_back(
        {name, NetcdfKind::text, {of, "len_name"}, {}, [rows = std::move(rows)](NetcdfValues& out) {
           for (const std::string& row : rows) out.add(row, kExodusNameBytes + 1);
         }});
  }
  static std::int32_t number(std::size_t value) {
    if (value > std::size_t{std::numeric_limits<std::int32_t>::max()})
      throw std::invalid_argument("a mesh of more than 2147483647 nodes or elements does not fit .exo");
    return static_cast<std::int32_t>(value);
  }

  void add_start() {
    content_.attributes = {{"api_version", 5.22F},
                           {"version", 5.22F},
                           {"floating_point_word_size", 8},
                           {"file_size", 1},
                           {"int64_status", 0},
                           {"maximum_name_length", 255},
                           {"title", std::string("mesh by Holdfast")}};
    dimension("len_string", 33);
    dimension("len_line", 81);
    dimension("len_name", kExodusNameBytes + 1);
    dimension("four", 4);
    dimension("time_step", 0);
    dimension("num_dim", 3);
    dimension("num_nodes", node_count(volume_));
    static_cast<void>(number(node_count(volume_)));
    content_.arrays.push_back({"time_whole", NetcdfKind::real, {"time_step"}});
    constexpr const char* kDirections[] = {"coordx", "coordy", "coordz"};
    for (std::size_t k = 0; k < 3 && node_count(volume_) > 0; ++k)
      content_.arrays.push_back(
          {kDirections[k], NetcdfKind::real, {"num_nodes"}, {}, [this, k](NetcdfValues& out) {
             for (std::size_t i = 0; i < node_count(volume_); ++i) {
               beat(watch_);
               out.add(node(volume_, i)[k]);
             }
           }});
    texts("coor_names", "num_dim", {"x", "y", "z"});
  }

  void add_blocks() {
    const bool second = is_second_order(volume_);
    std::vector<std::int32_t> ids;
    std::vector<std::string> names;
    element_of_.resize(volume_.tetrahedra.size());
    for (auto& [id, members] : labels_.regions.sets()) {
      for (const std::size_t t : members) element_of_[t] = number(++elements_);
      ids.push_back(id);
      names.push_back(labels_.regions.names.at(id));
      // Not TETRA4, which meshio does not know.
      add_block(ids.size(), second ? "TETRA10" : "TETRA", second ? 10 : 4, members,
                [this](std::size_t t) { return tetrahedron_nodes(volume_, t, kVtkEdges); });
    }
    std::set<int> taken(ids.begin(), ids.end());
    for (const auto& [id, members] : labels_.facets.sets()) {
      const std::vector<std::size_t> alone = of(members, false);
      if (alone.empty()) continue;
      int free = id;
      for (int next = 1; !taken.insert(free).second; ++next) free = next;
      elements_ += alone.size();
      ids.push_back(free);
      names.push_back(labels_.facets.names.at(id));
      add_block(ids.size(), second ? "TRI6" : "TRI3", second ? 6 : 3, alone,
                [this](std::size_t f) { return facet_nodes(volume_, f); });
    }
    if (ids.empty()) return;
    dimension("num_elem", static_cast<std::uint64_t>(number(elements_)));
    dimension("num_el_blk", ids.size());
    integers("eb_status", "num_el_blk", std::vector<std::int32_t>(ids.size(), 1));
    integers("eb_prop1", "num_el_blk", std::move(ids), {{"name", std::string("ID")}});
    texts("eb_names", "num_el_blk", std::move(names));
  }

  template <typename NodesOf>
  void add_block(std::size_t i, const char* type, std::uint64_t nodes_each, std::vector<std::size_t> members,
                 NodesOf nodes_of) {
    const std::string count = "num_el_in_blk" + std::to_string(i),
                      each = "num_nod_per_el" + std::to_string(i);
    dimension(count, members.size());
    dimension(each, nodes_each);
    content_.arrays.push_back({"connect" + std::to_string(i),
                               NetcdfKind::integer,
                               {count, each},
                               {{"elem_type", std::string(type)}},
                               [this, nodes_of, members = std::move(members)](NetcdfValues& out) {
                                 for (const std::size_t m : members) {
                                   beat(watch_);
                                   for (const Index v : nodes_of(m))
                                     out.add(static_cast<std::int32_t>(v + 1));
                                 }
                               }});
  }

  /// Of some facets, those with a tetrahedron at a side, or those without.
  [[nodiscard]] std::vector<std::size_t> of(const std::vector<std::size_t>& facets, bool with) const {
    std::vector<std::size_t> found;
    std::copy_if(facets.begin(), facets.end(), std::back_inserter(found),
                 [&](std::size_t f) { return (sides_[f].behind || sides_[f].front) == with; });
    return found;
  }

  void add_side_sets() {
    std::vector<std::int32_t> ids;
    std::vector<std::string> names;
    for (const auto& [id, members] : labels_.facets.sets()) {
      std::vector<std::int32_t> elements, sides;
      for (const std::size_t f : of(members, true)) {
        const SideOfTet at = sides_[f].behind ? *sides_[f].behind : *sides_[f].front;
        elements.push_back(element_of_[at.tetrahedron]);
        sides.push_back(static_cast<std::int32_t>(kExodusSideOpposite[at.side]));
      }
      if (elements.empty()) continue;
      ids.push_back(id);
      names.push_back(labels_.facets.names.at(id));
      const std::string i = std::to_string(ids.size()), count = "num_side_ss" + i;
      dimension(count, elements.size());
      integers("elem_ss" + i, count, std::move(elements));
      integers("side_ss" + i, count, std::move(sides));
    }
    add_sets("num_side_sets", "ss", std::move(ids), std::move(names));
  }

  void add_node_sets() {
    std::vector<std::int32_t> ids;
    std::vector<std::string> names;
    for (const auto& [id, members] : labels_.vertices.sets()) {
      std::vector<std::int32_t> nodes;
      for (const std::size_t v : members)
        if (volume_.vertex_markers[v] != 0) nodes.push_back(number(v + 1));
      if (nodes.empty()) continue;
      ids.push_back(id);
      names.push_back(labels_.vertices.names.at(id));
      const std::string i = std::to_string(ids.size()), count = "num_nod_ns" + i;
      dimension(count, nodes.size());
      integers("node_ns" + i, count, std::move(nodes));
    }
    add_sets("num_node_sets", "ns", std::move(ids), std::move(names));
  }

  void add_sets(const std::string& count, const std::string& prefix, std::vector<std::int32_t> ids,
                std::vector<std::string> names) {
    if (ids.empty()) return;
    dimension(count, ids.size());
    integers(prefix + "_status", count, std::vector<std::int32_t>(ids.size(), 1));
    integers(prefix + "_prop1", count, std::move(ids), {{"name", std::string("ID")}});
    texts(prefix + "_names", count, std::move(names));
  }

  const Volume& volume_;
  ExodusLabels labels_;
  Watch* watch_;
  std::vector<SidesOfFacet> sides_;
  NetcdfContent content_;
  std::vector<std::int32_t> element_of_;  ///< by tetrahedron, its number in the file
  std::size_t elements_ = 0;
};

}  // namespace

void write_exodus(AtomicWriter& out, const Volume& volume) { ExodusWriter(volume, out.watch()).write(out); }

std::vector<Remark> not_in_exodus(const Volume& volume, const WriteOptions&) {
  std::vector<Remark> remarks;
  ExodusLabels labels(volume);
  labels.vertices.renumbered.erase(0);  // vertices without a marker are in no set
  for (const Labels* of : {&labels.regions, &labels.facets, &labels.vertices}) tell(*of, ".exo", remarks);
  if (!volume.segments.empty())
    remarks.push_back({RemarkKind::not_held, volume.segments.size(),
                       std::to_string(volume.segments.size()) + " segments have no place in .exo"});
  return remarks;
}

}  // namespace holdfast::io
