// Writes the mesh of FEBio's models, .feb, version 4 (FEBio user's manual, "Mesh section"): a part of
// elements for each region, a surface for each marker, edges and node sets. Comments keep the ids; materials
// are the user's.
#include "io/solver_text.h"
#include "io/xml_reader.h"

namespace holdfast::io {
namespace {

constexpr NameRule kFebioNames{128, "_-.:/+()", true};

struct FebLabels : SolverLabels {
  MarkedVertices marked;

  explicit FebLabels(const Volume& volume)
      : SolverLabels(volume, kFebioNames, kAnyId), marked(volume, kFebioNames, kAnyId) {}
};

void write_list(AtomicWriter& out, const auto& nodes) {
  bool first = true;
  for (const Index v : nodes) {
    if (!first) out << ',';
    out << std::uint64_t{v} + 1;
    first = false;
  }
}

/// Groups of elements, each with a tag around it; `tag` is that of an element, `number` its id.
void write_groups(AtomicWriter& out, const Labels& labels, const std::string& around,
                  const std::string& attribute, std::string_view tag, auto&& number, auto&& nodes_of) {
  for (const auto& [id, members] : labels.sets()) {
    out << "    <" << around << attribute << " name=\"" << escaped(labels.names.at(id)) << "\">\n";
    for (std::size_t k = 0; k < members.size(); ++k) {
      beat(out.watch());
      out << "      <" << tag << " id=\"" << std::uint64_t{number(members[k], k)} << "\">";
      write_list(out, nodes_of(members[k]));
      out << "</" << tag << ">\n";
    }
    out << "    </" << around << ">\n";
  }
}

void write_febio_nodes(AtomicWriter& out, const Volume& volume) {
  out << "    <Nodes name=\"mesh\">\n";
  for (std::size_t i = 0; i < node_count(volume); ++i) {
    beat(out.watch());
    const Point& p = node(volume, i);
    out << "      <node id=\"" << std::uint64_t{i} + 1 << "\">" << p[0] << ',' << p[1] << ',' << p[2]
        << "</node>\n";
  }
  out << "    </Nodes>\n";
}

void write_febio_node_sets(AtomicWriter& out, const MarkedVertices& marked) {
  for (const auto& [id, members] : marked.labels.sets()) {
    std::vector<Index> nodes;
    for (const std::size_t k : members) nodes.push_back(marked.vertices[k]);
    out << "    <NodeSet name=\"" << escaped(marked.labels.names.at(id)) << "\">";
    write_list(out, nodes);
    out << "</NodeSet>\n";
  }
}

}  // namespace

void write_febio(AtomicWriter& out, const Volume& volume) {
  const FebLabels labels(volume);
  const bool second = is_second_order(volume), is_surface = volume.tetrahedra.empty();
  out << "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n<febio_spec version=\"4.0\">\n";
  for (const Labels* of : {&labels.regions, &labels.facets, &labels.segments, &labels.marked.labels})
    for (const auto& [id, name] : of->names)
      out << "  <!-- " << of->stem << ' ' << id << ' ' << escaped(name) << " -->\n";
  out << "  <Module type=\"solid\"/>\n  <Mesh>\n";
  write_febio_nodes(out, volume);
  const auto from_one = [](std::size_t i, std::size_t) { return std::uint64_t{i} + 1; };
  const auto in_group = [](std::size_t, std::size_t k) { return std::uint64_t{k} + 1; };
  const std::string_view triangle = second ? "tri6" : "tri3";
  const auto nodes_of_facet = [&](std::size_t i) { return facet_nodes(volume, i); };
  write_groups(out, labels.regions, "Elements", second ? " type=\"tet10\"" : " type=\"tet4\"", "elem",
               from_one, [&](std::size_t i) { return tetrahedron_nodes(volume, i, kVtkEdges); });
  if (is_surface)
    write_groups(out, labels.facets, "Elements", " type=\"" + std::string(triangle) + "\"", "elem", from_one,
                 nodes_of_facet);
  else
    write_groups(out, labels.facets, "Surface", "", triangle, in_group, nodes_of_facet);
  write_groups(out, labels.segments, "Edge", "", second ? "line3" : "line2", in_group,
               [&](std::size_t i) { return segment_nodes(volume, i); });
  write_febio_node_sets(out, labels.marked);
  out << "  </Mesh>\n  <MeshDomains>\n";
  for (const auto& [id, name] : is_surface ? labels.facets.names : labels.regions.names)
    out << (is_surface ? "    <ShellDomain name=\"" : "    <SolidDomain name=\"") << escaped(name)
        << "\" mat=\"\"/>\n";
  out << "  </MeshDomains>\n</febio_spec>\n";
}

std::vector<Remark> not_in_febio(const Volume& volume, const WriteOptions&) {
  std::vector<Remark> remarks;
  const FebLabels labels(volume);
  for (const Labels* of : {&labels.regions, &labels.facets, &labels.segments, &labels.marked.labels})
    tell(*of, ".feb", remarks);
  return remarks;
}

}  // namespace holdfast::io
