// Writes LS-DYNA's keyword files, .k (keyword user's manual, volume I): regions are parts, markers are sets
// of segments, markers of vertices sets of nodes. A surface without tetrahedra is parts of shells.
#include <algorithm>

#include "io/columns.h"
#include "io/exact_nodes.h"
#include "io/solver_text.h"
#include "text/count.h"

namespace holdfast::io {
namespace {

constexpr NameRule kDynaNames{70, "_-.:+/()#=", true};
constexpr std::int64_t kDynaMost = 99999999;  // eight digits
constexpr IdRule kDynaIds{true, static_cast<int>(kDynaMost)};

struct DynaLabels {
  Labels regions, facets;
  MarkedVertices marked;

  explicit DynaLabels(const Volume& volume)
      : regions(labels_of(kRegionStem, volume.regions, volume.tetrahedra.size(), volume.names.regions,
                          kDynaNames, kDynaIds)),
        facets(labels_of(kFacetStem, volume.facet_markers, volume.facets.size(), volume.names.facets,
                         kDynaNames, kDynaIds)),
        marked(volume, kDynaNames, kDynaIds) {}
};

void write_nodes(AtomicWriter& out, const Volume& volume) {
  write_exact_nodes(out, volume, "$", rounded_for_dyna);
  out << "*NODE\n";
  for (std::size_t i = 0; i < node_count(volume); ++i) {
    beat(out.watch());
    column(out, std::uint64_t{i} + 1, 8);
    for (const double x : node(volume, i)) column(out, short_real(x, kDynaCharacters), 16);
    out << '\n';
  }
}

void write_element(AtomicWriter& out, std::size_t element, int part, bool own_card, const auto& nodes) {
  beat(out.watch());
  column(out, std::uint64_t{element} + 1, 8);
  column(out, static_cast<std::uint64_t>(part), 8);
  if (own_card) out << '\n';
  for (const Index v : nodes) column(out, std::uint64_t{v} + 1, 8);
  out << '\n';
}

/// A tetrahedron is a hexahedron of repeated corners, or has a card of ten nodes.
void write_solids(AtomicWriter& out, const Volume& volume, const Labels& regions) {
  if (volume.tetrahedra.empty()) return;
  out << "*ELEMENT_SOLID\n";
  for (std::size_t i = 0; i < volume.tetrahedra.size(); ++i) {
    const Nodes n = tetrahedron_nodes(volume, i, kVtkEdges);
    if (n.count == 10)
      write_element(out, i, regions.ids[i], true, n);
    else
      write_element(out, i, regions.ids[i], false,
                    std::array{n.of[0], n.of[1], n.of[2], n.of[3], n.of[3], n.of[3], n.of[3], n.of[3]});
  }
}

void write_shells(AtomicWriter& out, const Volume& volume, const Labels& facets) {
  if (volume.facets.empty()) return;
  out << "*ELEMENT_SHELL\n";
  for (std::size_t i = 0; i < volume.facets.size(); ++i) {
    const Nodes n = facet_nodes(volume, i);
    if (n.count == 6)
      write_element(out, i, facets.ids[i], false,
                    std::array{n.of[0], n.of[1], n.of[2], n.of[2], n.of[3], n.of[4], n.of[5], n.of[5]});
    else
      write_element(out, i, facets.ids[i], false, std::array{n.of[0], n.of[1], n.of[2], n.of[2]});
  }
}

void write_parts(AtomicWriter& out, const Labels& labels) {
  for (const auto& [id, name] : labels.names) {
    out << "*PART\n" << name << '\n';
    column(out, static_cast<std::uint64_t>(id), 10);
    out << '\n';
  }
}

void write_set(AtomicWriter& out, std::string_view keyword, int id, const std::string& name) {
  out << keyword << '\n' << name << '\n';
  column(out, static_cast<std::uint64_t>(id), 10);
  out << '\n';
}

void write_segments(AtomicWriter& out, const Volume& volume, const Labels& facets) {
  for (const auto& [id, members] : facets.sets()) {
    write_set(out, "*SET_SEGMENT_TITLE", id, facets.names.at(id));
    for (const std::size_t f : members) {
      beat(out.watch());
      const Triangle& n = volume.facets[f];
      for (const Index v : {n[0], n[1], n[2], n[2]}) column(out, std::uint64_t{v} + 1, 10);
      out << '\n';
    }
  }
}

void write_node_sets(AtomicWriter& out, const MarkedVertices& marked) {
  for (const auto& [id, members] : marked.labels.sets()) {
    write_set(out, "*SET_NODE_LIST_TITLE", id, marked.labels.names.at(id));
    for (std::size_t k = 0; k < members.size(); ++k) {
      column(out, std::uint64_t{marked.vertices[members[k]]} + 1, 10);
      if (k % 8 == 7 || k + 1 == members.size()) out << '\n';
    }
  }
}

}  // namespace

void write_dyna(AtomicWriter& out, const Volume& volume) {
  if (std::max({node_count(volume), volume.tetrahedra.size(), volume.facets.size()}) >
      static_cast<std::size_t>(kDynaMost))
    throw std::invalid_argument("LS-DYNA's files number nodes and elements with eight digits");
  const DynaLabels labels(volume);
  const bool is_surface = volume.tetrahedra.empty();
  out << "*KEYWORD\n*TITLE\nmesh by Holdfast\n";
  write_nodes(out, volume);
  write_solids(out, volume, labels.regions);
  if (is_surface) write_shells(out, volume, labels.facets);
  write_parts(out, is_surface ? labels.facets : labels.regions);
  if (!is_surface) write_segments(out, volume, labels.facets);
  write_node_sets(out, labels.marked);
  out << "*END\n";
}

std::vector<Remark> not_in_dyna(const Volume& volume, const WriteOptions&) {
  std::vector<Remark> remarks;
  const DynaLabels labels(volume);
  for (const Labels* of : {&labels.regions, &labels.facets, &labels.marked.labels}) tell(*of, ".k", remarks);
  if (!volume.segments.empty())
    remarks.push_back({RemarkKind::not_held, volume.segments.size(),
                       counted(volume.segments.size(), "segment has", "segments have") + " no place in .k"});
  return remarks;
}

}  // namespace holdfast::io
