// Writes Abaqus's and CalculiX's .inp (CalculiX CrunchiX user's manual, "Input deck format").
//
// Regions are element sets; markers are surfaces of element sides, and sets of their nodes. Facets are
// elements of their own only if shells are requested, because a solver would compute with them.
#include <algorithm>

#include "io/exact_nodes.h"
#include "io/formats.h"
#include "io/labels.h"
#include "io/mesh_sets.h"

namespace holdfast::io {
namespace {

/// CalculiX reads 80 characters and ignores case.
constexpr NameRule kInpNames{80, "_-", false, false, true, false};

/// The numbers of the sides S1 to S4 of C3D4, by the opposite corner.
constexpr std::array<int, 4> kSides{3, 4, 2, 1};

struct InpData {
  const Volume& volume;
  Labels regions, facets, segments, vertices;
  std::vector<SidesOfFacet> sides;

  explicit InpData(const Volume& of)
      : volume(of),
        regions(
            labels_of(kRegionStem, of.regions, of.tetrahedra.size(), of.names.regions, kInpNames, kAnyId)),
        facets(labels_of(kFacetStem, of.facet_markers, of.facets.size(), of.names.facets, kInpNames, kAnyId)),
        segments(labels_of(kSegmentStem, of.segment_markers, of.segments.size(), of.names.segments, kInpNames,
                           kAnyId)),
        vertices(labels_of(kVertexStem, of.vertex_markers, of.vertex_markers.size(), of.names.vertices,
                           kInpNames, kAnyId)) {}
};

/// Writes numbers in lines of eight.
class List {
 public:
  explicit List(AtomicWriter& out) : out_(out) {}
  void add(std::uint64_t number) {
    if (count_ > 0) out_ << (count_ % 8 == 0 ? ",\n" : ", ");
    out_ << number;
    ++count_;
  }
  ~List() {
    if (count_ > 0) out_ << '\n';
  }

 private:
  AtomicWriter& out_;
  std::size_t count_ = 0;
};

template <typename NodesOf>
void write_node_sets(AtomicWriter& out, const Labels& labels, NodesOf&& nodes_of) {
  for (const auto& [id, members] : labels.sets()) {
    if (labels.stem == kVertexStem && id == 0) continue;
    std::vector<Index> nodes;
    for (const std::size_t i : members)
      for (const Index v : nodes_of(i)) nodes.push_back(v);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    out << "*NSET, NSET=" << labels.names.at(id) << '\n';
    List list(out);
    for (const Index v : nodes) list.add(std::uint64_t{v} + 1);
  }
}

template <typename NodesOf>
void write_elements(AtomicWriter& out, std::string_view type, const Labels& labels, std::uint64_t first,
                    NodesOf&& nodes_of) {
  for (const auto& [id, members] : labels.sets()) {
    out << "*ELEMENT, TYPE=" << type << ", ELSET=" << labels.names.at(id) << '\n';
    for (const std::size_t i : members) {
      beat(out.watch());
      out << first + i;
      for (const Index v : nodes_of(i)) out << ", " << std::uint64_t{v} + 1;
      out << '\n';
    }
  }
}

void write_surfaces(AtomicWriter& out, const InpData& data) {
  const std::vector<SidesOfFacet> sides = sides_of_facets(data.volume);
  for (const auto& [id, members] : data.facets.sets()) {
    out << "*SURFACE, NAME=" << data.facets.names.at(id) << ", TYPE=ELEMENT\n";
    for (const std::size_t i : members) {
      const std::optional<SideOfTet>& side = sides[i].behind ? sides[i].behind : sides[i].front;
      if (side) out << std::uint64_t{side->tetrahedron} + 1 << ", S" << kSides[side->side] << '\n';
    }
  }
}

}  // namespace

void write_inp(AtomicWriter& out, const Volume& volume, const WriteOptions& options) {
  InpData data(volume);
  const bool second = is_second_order(volume);
  out << "*HEADING\nmesh by Holdfast\n";
  for (const Labels* labels : {&data.regions, &data.facets}) write_id_comments(out, "**", *labels);
  write_exact_nodes(out, volume, "**", rounded_for_inp);
  out << "*NODE\n";
  for (std::size_t i = 0; i < node_count(volume); ++i) {
    beat(out.watch());
    const Point& p = node(volume, i);
    out << std::uint64_t{i} + 1;
    for (const double x : p) out << ", " << short_real(x, kInpCharacters);
    out << '\n';
  }
  write_elements(out, second ? "C3D10" : "C3D4", data.regions, 1,
                 [&](std::size_t i) { return tetrahedron_nodes(volume, i, kVtkEdges); });
  const bool no_tetrahedra = volume.tetrahedra.empty();
  if (options.shells || no_tetrahedra) {
    // Names of element sets must be unique.
    Labels shells = data.facets;
    if (!no_tetrahedra)
      for (auto& [id, name] : shells.names) name = "SH_" + name.substr(0, 77);
    write_elements(out, second ? "S6" : "S3", shells, volume.tetrahedra.size() + 1,
                   [&](std::size_t i) { return facet_nodes(volume, i); });
  }
  write_node_sets(out, data.facets, [&](std::size_t i) { return facet_nodes(volume, i); });
  write_node_sets(out, data.segments, [&](std::size_t i) { return segment_nodes(volume, i); });
  write_node_sets(out, data.vertices, [&](std::size_t i) { return std::array{static_cast<Index>(i)}; });
  if (!no_tetrahedra) write_surfaces(out, data);
}

std::vector<Remark> not_in_inp(const Volume& volume, const WriteOptions& options) {
  const InpData data(volume);
  std::vector<Remark> remarks;
  for (const Labels* labels : {&data.regions, &data.facets, &data.segments, &data.vertices})
    tell(*labels, ".inp", remarks);
  const auto say = [&](std::size_t count, const std::string& what) {
    if (count > 0) remarks.push_back({RemarkKind::not_held, count, std::to_string(count) + what});
  };
  say(volume.segments.size(), " segments are no elements in .inp, but sets of nodes");
  if (!options.shells && !volume.tetrahedra.empty()) {
    const std::vector<SidesOfFacet> sides = sides_of_facets(volume);
    say(static_cast<std::size_t>(std::count_if(
            sides.begin(), sides.end(), [](const SidesOfFacet& of) { return !of.behind && !of.front; })),
        " facets are at no tetrahedron, and so in no surface of .inp");
  }
  return remarks;
}

}  // namespace holdfast::io
