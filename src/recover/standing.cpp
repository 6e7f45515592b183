#include "recover/standing.h"

#include <algorithm>

#include "mesh/traverse.h"

namespace holdfast {
namespace {

std::size_t zeros(const std::vector<std::uint8_t>& flags) {
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), std::uint8_t{0}));
}

// The facets whose least vertex is v are order[first[v]] .. order[first[v + 1] - 1].
struct FacetsByLeastVertex {
  std::vector<Index> first, order;

  FacetsByLeastVertex(std::size_t vertices, std::span<const Triangle> facets) : first(vertices + 1, 0) {
    const auto least = [&](Index f) { return std::min({facets[f][0], facets[f][1], facets[f][2]}); };
    for (Index f = 0; f < facets.size(); ++f) ++first[least(f) + 1];
    for (std::size_t v = 0; v < vertices; ++v) first[v + 1] += first[v];
    std::vector<Index> next(first.begin(), first.end() - 1);
    order.resize(facets.size());
    for (Index f = 0; f < facets.size(); ++f) order[next[least(f)]++] = f;
  }
};

class Marker {
 public:
  Marker(TetMesh& mesh, const SegmentTable& table, std::span<const Triangle> facets)
      : mesh_(mesh),
        table_(table),
        facets_(facets),
        by_vertex_(mesh.vertex_count(), facets),
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
    for (Index k = by_vertex_.first[a]; k < by_vertex_.first[a + 1]; ++k) {
      const Index f = by_vertex_.order[k];
      const Triangle& corners = facets_[f];
      if (std::find(corners.begin(), corners.end(), bc[0]) == corners.end() ||
          std::find(corners.begin(), corners.end(), bc[1]) == corners.end())
        continue;
      mesh_.set_flags(t, facet_bit(face));
      standing_.facets[f] = 1;
      return;
    }
  }

  TetMesh& mesh_;
  const SegmentTable& table_;
  std::span<const Triangle> facets_;
  const FacetsByLeastVertex by_vertex_;
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
