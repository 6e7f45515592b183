#include "recover/standing.h"

#include <algorithm>

#include "mesh/traverse.h"
#include "surface/facet_index.h"

namespace holdfast {
namespace {

std::size_t zeros(const std::vector<std::uint8_t>& flags) {
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), std::uint8_t{0}));
}

class Marker {
 public:
  Marker(TetMesh& mesh, const SegmentTable& table, std::span<const Triangle> facets)
      : mesh_(mesh),
        table_(table),
        index_(mesh.vertex_count(), facets),
        wanted_(mesh.vertex_count(), kNone),
        standing_{std::vector<std::uint8_t>(table.segments.size(), 0),
                  std::vector<std::uint8_t>(facets.size(), 0)} {}

  Standing run() {
    std::size_t s = 0;
    while (s < table_.segments.size()) {
      const Vertex a = table_.segments[s][0];
      const std::size_t begin = s;
      for (; s < table_.segments.size() && table_.segments[s][0] == a; ++s)
        wanted_[table_.segments[s][1]] = static_cast<Index>(s);
      mark_ball(a);
      for (std::size_t k = begin; k < s; ++k) wanted_[table_.segments[k][1]] = kNone;
    }
    return std::move(standing_);
  }

 private:
  // Every tetrahedron of a segment's shell, and both at a facet, lie in the ball of its least vertex.
  void mark_ball(Vertex a) {
    tets_.clear();
    ball(mesh_, a, tets_);
    for (const Tet t : tets_) {
      if (mesh_.is_ghost(t)) continue;
      const int i = mesh_.index_of(t, a);
      for (int k = 0; k < 4; ++k) {
        const Vertex b = mesh_.corner(t, k);
        if (k == i || wanted_[b] == kNone) continue;
        mesh_.set_flags(t, segment_bit(kEdgeOf[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)]));
        standing_.segments[wanted_[b]] = 1;
      }
      for (int k = 0; k < 4; ++k)
        if (k != i) mark_face(a, t, k);
    }
  }

  void mark_face(Vertex a, Tet t, int face) {
    std::array<Vertex, 2> bc{};
    std::size_t n = 0;
    for (const Vertex v : mesh_.face_vertices(face_code(t, face)))
      if (v != a) bc[n++] = v;
    if (wanted_[bc[0]] == kNone || wanted_[bc[1]] == kNone) return;
    const Index f = index_.find({a, bc[0], bc[1]});
    if (f == no_index) return;
    mesh_.set_flags(t, facet_bit(face));
    standing_.facets[f] = 1;
  }

  TetMesh& mesh_;
  const SegmentTable& table_;
  const FacetIndex index_;
  std::vector<Index> wanted_;  // by vertex: the segment from the current vertex to it
  Standing standing_;
  std::vector<Tet> tets_;
};

}  // namespace

std::size_t Standing::missing_segments() const { return zeros(segments); }
std::size_t Standing::missing_facets() const { return zeros(facets); }

Standing mark_present(TetMesh& mesh, const SegmentTable& table, std::span<const Triangle> facets) {
  return Marker(mesh, table, facets).run();
}

}  // namespace holdfast
