// Reads surfaces of the GNU Triangulated Surface library, .gts (GTS reference manual, "gts_surface_write"):
// vertices, edges of two vertices, faces of three edges. A fourth number of a face is its marker, as OpenFOAM
// writes it.
#include <array>

#include "io/formats.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

class GtsReader {
 public:
  explicit GtsReader(const Source& source) : text_(source), mesh_(source) {}

  MeshData read() {
    const std::size_t vertices = text_.count("the number of vertices", 6);
    const std::size_t edges = text_.count("the number of edges", 4);
    const std::size_t faces = text_.count("the number of faces", 6);
    for (std::string_view word = text_.word_on_line(); !word.empty(); word = text_.word_on_line())
      if (word.find("Binary") != std::string_view::npos)
        text_.fail("binary files are not read; save it as text");
    for (std::size_t i = 0; i < vertices; ++i) {
      mesh_.vertices.push_back(text_.point());
      text_.skip_line();
    }
    for (std::size_t i = 0; i < edges; ++i) {
      const Index first = text_.index("a vertex", 1, vertices);
      edges_.push_back({first, text_.index("a vertex", 1, vertices)});
      text_.skip_line();
    }
    is_used_.resize(edges, false);
    for (std::size_t i = 0; i < faces; ++i) read_face();
    for (std::size_t i = 0; i < edges; ++i)
      if (!is_used_[i]) mesh_.add_segment(edges_[i]);
    return std::move(mesh_);
  }

 private:
  /// The corners: the other end of the first edge, the vertex of the first two, the other end of the second.
  void read_face() {
    std::array<Segment, 3> sides{};
    for (Segment& side : sides) {
      const Index edge = text_.index("an edge", 1, edges_.size());
      is_used_[edge] = true;
      side = edges_[edge];
    }
    const std::size_t place = text_.last();
    int marker = 0;
    if (!text_.at_line_end() && text_.number_follows()) marker = text_.tag("a marker");
    text_.skip_line();
    auto& [one, two, three] = sides;
    if (one[0] == two[0] || one[0] == two[1]) std::swap(one[0], one[1]);
    if (one[1] != two[0]) std::swap(two[0], two[1]);
    const bool closes = one[1] == two[0] && ((three[0] == two[1] && three[1] == one[0]) ||
                                             (three[1] == two[1] && three[0] == one[0]));
    if (!closes) text_.fail_at(place, "the three edges of a face are no triangle");
    mesh_.add_facet({one[0], one[1], two[1]}, marker);
  }

  TextReader text_;
  MeshData mesh_;
  std::vector<Segment> edges_;
  std::vector<bool> is_used_;  ///< by edge, whether a face has it
};

}  // namespace

MeshData read_gts(const Source& source) { return GtsReader(source).read(); }

}  // namespace holdfast::io
