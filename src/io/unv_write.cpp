// Writes I-DEAS universal files (SDRC, "Universal file datasets": 2411 nodes, 2412 elements, 2467 and 2477
// permanent groups). Groups are in both datasets, because OpenFOAM reads the one and Gmsh the other; inner
// facets are only in the second, because OpenFOAM's ideasUnvToFoam makes broken cell zones of them.
#include <array>
#include <charconv>
#include <set>

#include "io/columns.h"
#include "io/formats.h"
#include "io/labels.h"
#include "io/mesh_sets.h"

namespace holdfast::io {
namespace {

constexpr NameRule kUnvNames{40, "_-."};
/// Nine digits leave a blank in a column of ten, for readers that split at blanks.
constexpr IdRule kUnvIds{true, 999999999};
constexpr std::size_t kUnvColumn = 10, kUnvRealColumn = 25;

/// Writes 17 digits in a column of 25, with Fortran's double-precision exponent.
void unv_real(AtomicWriter& out, double value) {
  char digits[40];
  const auto result = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::scientific, 16);
  const auto size = static_cast<std::size_t>(result.ptr - digits);
  for (char& c : digits)
    if (c == 'e') c = 'D';
  column(out, std::string_view(digits, size), kUnvRealColumn);
}

void begin(AtomicWriter& out, int dataset) {
  out << "    -1\n";
  const std::string number = std::to_string(dataset);
  out << std::string(6 - number.size(), ' ') << number << '\n';
}
void end(AtomicWriter& out) { out << "    -1\n"; }

/// I-DEAS's order: corners and mid-edge nodes alternate round a face, then come the nodes on the edges to the
/// last corner, then that corner.
Nodes parabolic(const Nodes& nodes) {
  if (nodes.count == 10) {
    const auto& n = nodes.of;
    return {{n[0], n[4], n[1], n[5], n[2], n[6], n[7], n[8], n[9], n[3]}, 10};
  }
  if (nodes.count == 6) {
    const auto& n = nodes.of;
    return {{n[0], n[3], n[1], n[4], n[2], n[5]}, 6};
  }
  return nodes;
}

class UnvWriter {
 public:
  UnvWriter(AtomicWriter& out, const Volume& volume)
      : out_(out),
        volume_(volume),
        regions_(labels_of(kRegionStem, volume.regions, volume.tetrahedra.size(), volume.names.regions,
                           kUnvNames, kUnvIds)),
        facets_(labels_of(kFacetStem, volume.facet_markers, volume.facets.size(), volume.names.facets,
                          kUnvNames, kUnvIds)),
        segments_(labels_of(kSegmentStem, volume.segment_markers, volume.segments.size(),
                            volume.names.segments, kUnvNames, kUnvIds)) {}

  void write() {
    write_nodes();
    write_elements();
    for (const int dataset : {2467, 2477}) write_groups(dataset);
  }

 private:
  void write_nodes() {
    begin(out_, 2411);
    for (std::size_t i = 0; i < node_count(volume_); ++i) {
      beat(out_.watch());
      for (const std::int64_t value :
           {static_cast<std::int64_t>(i) + 1, std::int64_t{1}, std::int64_t{1}, std::int64_t{11}})
        column(out_, value, kUnvColumn);
      out_ << '\n';
      for (const double x : node(volume_, i)) unv_real(out_, x);
      out_ << '\n';
    }
    end(out_);
  }

  /// The id is the physical property, and the colour, of which code_saturne makes groups. The material is
  /// left empty, because Gmsh would make groups of it, too.
  void element(int type, int id, const Nodes& nodes) {
    beat(out_.watch());
    for (const std::int64_t value : {++number_, std::int64_t{type}, std::int64_t{id}, std::int64_t{0},
                                     std::int64_t{id}, static_cast<std::int64_t>(nodes.count)})
      column(out_, value, kUnvColumn);
    out_ << '\n';
    if (type == 11 || type == 24)
      out_ << "         0         1         1\n";  // a beam's orientation and ends
    std::size_t on_line = 0;
    for (const Index v : nodes) {
      if (on_line == 8) out_ << '\n';
      if (on_line == 8) on_line = 0;
      column(out_, std::int64_t{v} + 1, kUnvColumn);
      ++on_line;
    }
    out_ << '\n';
  }

  void write_elements() {
    const bool second = is_second_order(volume_);
    begin(out_, 2412);
    for (std::size_t i = 0; i < volume_.tetrahedra.size(); ++i)
      element(second ? 118 : 111, regions_.ids[i], parabolic(tetrahedron_nodes(volume_, i, kVtkEdges)));
    for (std::size_t i = 0; i < volume_.facets.size(); ++i)
      element(second ? 92 : 91, facets_.ids[i], parabolic(facet_nodes(volume_, i)));
    for (std::size_t i = 0; i < volume_.segments.size(); ++i) {
      Nodes nodes = segment_nodes(volume_, i);
      if (nodes.count == 3) std::swap(nodes.of[1], nodes.of[2]);
      element(second ? 24 : 11, segments_.ids[i], nodes);
    }
    end(out_);
  }

  /// The group's number: its id, which Gmsh reads from it, unless another group has that.
  static std::int64_t number_of_group(std::set<int>& numbers, int id) {
    while (!numbers.insert(id).second) id = id % 1000000 + 1;
    return id;
  }

  void write_groups(int dataset) {
    begin(out_, dataset);
    std::set<int> numbers;
    std::size_t first = 1;
    const std::vector<SidesOfFacet> sides =
        dataset == 2467 ? sides_of_facets(volume_) : std::vector<SidesOfFacet>();
    const auto is_inside = [&](std::size_t f) { return !sides.empty() && sides[f].behind && sides[f].front; };
    for (const Labels* labels : {&regions_, &facets_, &segments_}) {
      for (auto& [id, all] : labels->sets()) {
        std::vector<std::size_t> members = all;
        if (labels == &facets_) std::erase_if(members, is_inside);
        if (members.empty()) continue;
        column(out_, number_of_group(numbers, id), kUnvColumn);
        for (int i = 0; i < 6; ++i) column(out_, 0, kUnvColumn);
        column(out_, static_cast<std::int64_t>(members.size()), kUnvColumn);
        out_ << '\n' << labels->names.at(id) << '\n';
        for (std::size_t i = 0; i < members.size(); ++i) {
          for (const std::size_t value : {std::size_t{8}, first + members[i], std::size_t{0}, std::size_t{0}})
            column(out_, static_cast<std::int64_t>(value), kUnvColumn);
          if (i % 2 == 1 || i + 1 == members.size()) out_ << '\n';
        }
      }
      first += labels->ids.size();
    }
    end(out_);
  }

  AtomicWriter& out_;
  const Volume& volume_;
  Labels regions_, facets_, segments_;
  std::int64_t number_ = 0;
};

}  // namespace

void write_unv(AtomicWriter& out, const Volume& volume) { UnvWriter(out, volume).write(); }

std::vector<Remark> not_in_unv(const Volume& volume, const WriteOptions&) {
  std::vector<Remark> remarks;
  const Names& names = volume.names;
  tell(labels_of(kRegionStem, volume.regions, volume.tetrahedra.size(), names.regions, kUnvNames, kUnvIds),
       ".unv", remarks);
  tell(labels_of(kFacetStem, volume.facet_markers, volume.facets.size(), names.facets, kUnvNames, kUnvIds),
       ".unv", remarks);
  tell(labels_of(kSegmentStem, volume.segment_markers, volume.segments.size(), names.segments, kUnvNames,
                 kUnvIds),
       ".unv", remarks);
  tell_marked_vertices(volume, ".unv", remarks);
  return remarks;
}

}  // namespace holdfast::io
