// Writes Ansys MAPDL's archive files, .cdb, as CDWRITE does (Mechanical APDL command reference: NBLOCK,
// EBLOCK, CMBLOCK). Tetrahedra are SOLID285 or SOLID187; facets and segments are MESH200, which takes no part
// in an analysis. Materials are the regions and markers, and a component of elements has the name of each.
#include <algorithm>
#include <charconv>
#include <set>

#include "io/cdb_elements.h"
#include "io/columns.h"
#include "io/solver_text.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

constexpr NameRule kCdbNames{32, "_", false, false, true, false};
constexpr std::int64_t kCdbMost = 99999999;  // eight digits leave a blank between columns of nine
constexpr IdRule kCdbIds{true, static_cast<int>(kCdbMost)};
constexpr std::size_t kColumn = 9, kRealColumn = 25;

/// 17 digits and an exponent of three, as e25.16e3 has them.
void cdb_real(AtomicWriter& out, double value) {
  char digits[40];
  const auto result = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::scientific, 16);
  std::string text(digits, result.ptr);
  const std::size_t mark = text.find('e');
  if (mark != std::string::npos) {
    text[mark] = 'E';
    if (text.size() - mark < 5) text.insert(mark + 2, 1, '0');
  }
  column(out, text, kRealColumn);
}

struct CdbLabels : SolverLabels {
  MarkedVertices marked;

  explicit CdbLabels(const Volume& volume)
      : SolverLabels(volume, kCdbNames, kCdbIds), marked(volume, kCdbNames, {false}) {
    set_apart();
  }

 private:
  /// All components have different names.
  void set_apart() {
    std::set<std::string> taken;
    for (Labels* labels : {&regions, &facets, &segments, &marked.labels})
      for (auto& [id, name] : labels->names) {
        const std::string wanted = name;
        for (int copy = 2; taken.contains(lower(name)); ++copy) {
          const std::string tail = "_" + std::to_string(copy);
          name = wanted.substr(0, kCdbNames.longest - tail.size()) + tail;
        }
        taken.insert(lower(name));
        if (name != wanted) ++labels->changed_names;
      }
  }
};

class CdbWriter {
 public:
  CdbWriter(AtomicWriter& out, const Volume& volume) : out_(out), volume_(volume), labels_(volume) {}

  void write() {
    const bool second = is_second_order(volume_);
    out_ << "/COM,mesh by Holdfast\n";
    // Components of nodes have no number but their name's.
    for (const auto& [id, name] : labels_.marked.labels.names)
      if (volume_.names.vertices.contains(id))
        out_ << "/COM, " << kVertexStem << ' ' << id << ' ' << name << '\n';
    out_ << "/PREP7\nET,1," << (second ? kSolid187 : kSolid285) << "\nET,2," << kMesh200 << "\nKEYOPT,2,1,"
         << (second ? kMesh200Triangle6 : kMesh200Triangle3) << "\nET,3," << kMesh200 << "\nKEYOPT,3,1,"
         << (second ? kMesh200Line3 : kMesh200Line2) << '\n';
    write_nodes();
    write_elements();
    std::uint64_t first = 1;
    for (const Labels* labels : {&labels_.regions, &labels_.facets, &labels_.segments}) {
      for (const auto& [id, members] : labels->sets())
        write_component(labels->names.at(id), "ELEM", members, [&](std::size_t i) { return first + i; });
      first += labels->ids.size();
    }
    write_vertex_components();
    out_ << "FINISH\n";
  }

 private:
  void write_nodes() {
    const std::size_t count = node_count(volume_);
    out_ << "NBLOCK,6,SOLID," << std::uint64_t{count} << ',' << std::uint64_t{count} << "\n(3i9,6e25.16e3)\n";
    for (std::size_t i = 0; i < count; ++i) {
      beat(out_.watch());
      column(out_, std::uint64_t{i} + 1, kColumn);
      column(out_, 0, kColumn);
      column(out_, 0, kColumn);
      for (const double x : node(volume_, i)) cdb_real(out_, x);
      out_ << '\n';
    }
    out_ << "N,R5.3,LOC,       -1,\n";
  }

  void write_elements() {
    const std::size_t count = volume_.tetrahedra.size() + volume_.facets.size() + volume_.segments.size();
    if (count == 0) return;
    out_ << "EBLOCK,19,SOLID," << std::uint64_t{count} << ',' << std::uint64_t{count} << "\n(19i9)\n";
    for (std::size_t i = 0; i < volume_.tetrahedra.size(); ++i)
      write_element(1, labels_.regions.ids[i], tetrahedron_nodes(volume_, i, kVtkEdges));
    for (std::size_t i = 0; i < volume_.facets.size(); ++i)
      write_element(2, labels_.facets.ids[i], facet_nodes(volume_, i));
    for (std::size_t i = 0; i < volume_.segments.size(); ++i)
      write_element(3, labels_.segments.ids[i], segment_nodes(volume_, i));
    column(out_, "-1", kColumn);
    out_ << '\n';
  }

  /// Material, type, real constants, section, coordinate system, death, model, shape, nodes, unused, number.
  void write_element(std::uint64_t type, int material, const Nodes& nodes) {
    beat(out_.watch());
    const std::uint64_t head[] = {
        static_cast<std::uint64_t>(material), type, 1, 1, 0, 0, 0, 0, nodes.count, 0, ++element_};
    for (const std::uint64_t value : head) column(out_, value, kColumn);
    for (std::size_t i = 0; i < nodes.count; ++i) {
      if (i == 8) out_ << '\n';
      column(out_, std::uint64_t{nodes.of[i]} + 1, kColumn);
    }
    out_ << '\n';
  }

  void write_component(const std::string& name, std::string_view kind,
                       const std::vector<std::size_t>& members, auto&& number) {
    out_ << "CMBLOCK," << name << ',' << kind << ',' << std::uint64_t{members.size()} << "\n(8i10)\n";
    for (std::size_t k = 0; k < members.size(); ++k) {
      column(out_, std::uint64_t{number(members[k])}, 10);
      if (k % 8 == 7 || k + 1 == members.size()) out_ << '\n';
    }
  }

  void write_vertex_components() {
    for (const auto& [id, members] : labels_.marked.labels.sets())
      write_component(labels_.marked.labels.names.at(id), "NODE", members,
                      [&](std::size_t i) { return std::uint64_t{labels_.marked.vertices[i]} + 1; });
  }

  AtomicWriter& out_;
  const Volume& volume_;
  CdbLabels labels_;
  std::uint64_t element_ = 0;  ///< the last number
};

}  // namespace

void write_cdb(AtomicWriter& out, const Volume& volume) {
  const std::size_t elements = volume.tetrahedra.size() + volume.facets.size() + volume.segments.size();
  if (std::max(node_count(volume), elements) > static_cast<std::size_t>(kCdbMost))
    throw std::invalid_argument("a mesh of more than 99999999 nodes or elements does not fit .cdb");
  CdbWriter(out, volume).write();
}

std::vector<Remark> not_in_cdb(const Volume& volume, const WriteOptions&) {
  std::vector<Remark> remarks;
  const CdbLabels labels(volume);
  for (const Labels* of : {&labels.regions, &labels.facets, &labels.segments, &labels.marked.labels})
    tell(*of, ".cdb", remarks);
  return remarks;
}

}  // namespace holdfast::io
