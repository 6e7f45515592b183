// Reads the UCD format of AVS as text (.avs, .ucd; LaGriT and others name it .inp, too): nodes, and cells
// with a material (AVS developer's guide, "UCD format"). The material of a cell is its region or marker;
// values at nodes and of cells are skipped.
#include <algorithm>
#include <array>
#include <span>

#include "io/cells.h"
#include "io/formats.h"
#include "io/numbered.h"
#include "io/polygon.h"
#include "io/text_reader.h"
#include "io/turn.h"

namespace holdfast::io {
namespace {

struct AvsCell {
  std::string_view name;
  std::size_t corners;
};
constexpr std::array kCells{AvsCell{"pt", 1},  AvsCell{"line", 2}, AvsCell{"tri", 3},   AvsCell{"quad", 4},
                            AvsCell{"tet", 4}, AvsCell{"pyr", 5},  AvsCell{"prism", 6}, AvsCell{"hex", 8}};

class AvsReader {
 public:
  explicit AvsReader(const Source& source) : text_(source), mesh_(source) {}

  MeshData read() {
    const std::size_t nodes = text_.count("the number of nodes", 8);
    const std::size_t cells = text_.count("the number of cells", 8);
    std::array<std::int64_t, 3> values{};  // at nodes, of cells, of the model
    for (std::int64_t& count : values) count = text_.integer("a number of values");
    text_.skip_line();
    read_nodes(nodes);
    for (std::size_t i = 0; i < cells; ++i) read_cell();
    for (std::size_t i = 0; i < markers_.size(); ++i) mesh_.vertex_markers.add(i, markers_[i]);
    turn_to_vtk(mesh_);
    if (values[0] > 0) mesh_.remarks.push_back({RemarkKind::left_out, 1, "values at nodes are left out"});
    if (values[1] > 0) mesh_.remarks.push_back({RemarkKind::left_out, 1, "values of cells are left out"});
    return std::move(mesh_);
  }

 private:
  void read_nodes(std::size_t count) {
    mesh_.vertices.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      numbers_.add(text_.integer("a node's number"));
      mesh_.vertices.push_back(text_.point());
      text_.skip_line();
      step(text_.source().watch);
    }
    if (const auto twice = numbers_.finish())
      throw FileError(text_.source().path, "", "the node " + std::to_string(*twice) + " occurs twice");
  }

  /// Reads the number, the material, the kind as a word, and the nodes.
  void read_cell() {
    static_cast<void>(text_.integer("a cell's number"));
    const int material = text_.tag("a material");
    const std::string kind = lower(text_.word("the kind of a cell"));
    const auto* const cell =
        std::find_if(kCells.begin(), kCells.end(), [&](const AvsCell& c) { return c.name == kind; });
    if (cell == kCells.end())
      text_.fail("cells of the kind " + in_quotes(kind) +
                 " are not read; only pt, line, tri, quad, tet, pyr, prism and hex are");
    std::array<Index, 8> n{};
    for (std::size_t k = 0; k < cell->corners; ++k) n[k] = node();
    text_.skip_line();
    step(text_.source().watch);
    if (kind == "pt")
      mark(n[0], material);
    else if (kind == "line")
      mesh_.add_segment({n[0], n[1]}, material);
    else if (kind == "tet")
      mesh_.add_tetrahedron({n[0], n[1], n[2], n[3]}, material);
    else if (cell->corners > 4)
      add(std::span(n).first(cell->corners), material);
    else
      add_polygon(mesh_, std::span(n).first(cell->corners), material,
                  [&](const std::string& reason) { text_.fail(reason); });
  }

  void add(std::span<Index> cell, int material) {
    if (cell.size() == 5) std::rotate(cell.begin(), cell.begin() + 1, cell.end());  // the apex is first
    add_cell(mesh_, cell, cell.size(), material);
  }

  Index node() {
    const std::int64_t number = text_.integer("a node");
    const std::optional<Index> found = numbers_.find(number);
    if (!found) text_.fail("the node " + std::to_string(number) + " does not exist");
    return *found;
  }

  void mark(Index vertex, int material) {
    if (material == 0) return;
    markers_.resize(mesh_.vertices.size(), 0);
    markers_[vertex] = material;
  }

  TextReader text_;
  MeshData mesh_;
  Numbered numbers_;
  std::vector<int> markers_;  ///< by vertex, if any is marked
};

}  // namespace

bool is_avs(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t start = bytes.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos) return false;
    if (bytes[start] != '#') return bytes[start] >= '0' && bytes[start] <= '9';
    const std::size_t end = bytes.find('\n', start);
    if (end == std::string_view::npos) return false;
    bytes.remove_prefix(end);
  }
  return false;
}

MeshData read_avs(const Source& source) { return AvsReader(source).read(); }

}  // namespace holdfast::io
