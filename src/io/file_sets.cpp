#include "io/file_sets.h"

#include <algorithm>

#include "io/cells.h"
#include "io/mid_nodes.h"

namespace holdfast::io {

FacetSets::FacetSets(MeshData& mesh) : mesh_(mesh), sizes_(mesh.facets.size(), kNoSet) {
  for (Index f = 0; f < mesh.facets.size(); ++f) {
    facet_of_.emplace(ascending(mesh.facets[f]), f);
    markers_.push_back(mesh.facet_markers.of(f));
  }
}

void FacetSets::remark(Index facet, const SetOfFile& set) {
  overlaps_ += sizes_[facet] != kNoSet && markers_[facet] != set.marker ? 1 : 0;
  if (sizes_[facet] <= set.size) return;
  sizes_[facet] = set.size;
  markers_[facet] = set.marker;
}

std::vector<Triangle> FacetSets::triangles_of(std::span<const Index> corners) const {
  if (corners.size() == 4)
    for (const std::size_t k : {0U, 1U}) {
      const Index a = corners[k], b = corners[k + 1], c = corners[k + 2], d = corners[(k + 3) % 4];
      std::vector<Triangle> halves{{a, b, c}, {a, c, d}};
      if (facet_of_.contains(ascending(halves[0])) && facet_of_.contains(ascending(halves[1]))) return halves;
    }
  return triangles_of_side(corners);
}

void FacetSets::finish() {
  mesh_.facet_markers = {};
  for (std::size_t f = 0; f < markers_.size(); ++f) mesh_.facet_markers.add(f, markers_[f]);
  mesh_.leave_out(overlaps_, "memberships of sides in larger side sets",
                  "membership of a side in a larger side set");
}

void mark_vertices(MeshData& mesh, std::vector<VertexSet> sets) {
  // The largest first, so that smaller ones overwrite it.
  std::stable_sort(sets.begin(), sets.end(), [](const VertexSet& a, const VertexSet& b) {
    return a.vertices.size() > b.vertices.size();
  });
  std::vector<int> markers(mesh.vertices.size(), 0);
  std::size_t overlaps = 0;
  for (const VertexSet& set : sets)
    for (const Index v : set.vertices) {
      overlaps += markers[v] != 0 ? 1 : 0;
      markers[v] = set.marker;
    }
  for (std::size_t v = 0; v < markers.size(); ++v) mesh.vertex_markers.add(v, markers[v]);
  mesh.leave_out(overlaps, "memberships of nodes in larger node sets",
                 "membership of a node in a larger node set");
}

std::vector<Triangle> boundary_of(const MeshData& mesh) {
  std::vector<std::pair<Triangle, Triangle>> faces;  // with its corners in ascending order first
  faces.reserve(4 * mesh.tetrahedra.size());
  for (const Tetrahedron& t : mesh.tetrahedra)
    for (std::size_t i = 0; i < 4; ++i) faces.emplace_back(ascending(outward_face(t, i)), outward_face(t, i));
  std::sort(faces.begin(), faces.end());
  std::vector<Triangle> boundary;
  for (std::size_t i = 0, j = 0; i < faces.size(); i = j) {
    while (j < faces.size() && faces[j].first == faces[i].first) ++j;
    if (j == i + 1) boundary.push_back(faces[i].second);
  }
  return boundary;
}

NodesOnEdges::NodesOnEdges(const MeshData& mesh) {
  constexpr std::array<std::array<std::size_t, 2>, 6> kEdges{
      {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
  for (std::size_t t = 0; t < mesh.mids.tetrahedra.size(); ++t)
    for (std::size_t e = 0; e < kEdges.size(); ++e) {
      const Tetrahedron& corners = mesh.tetrahedra[t];
      const Index node = mesh.mids.tetrahedra[t][e];
      if (node != no_entity)
        nodes_.emplace_back(ascending(Segment{corners[kEdges[e][0]], corners[kEdges[e][1]]}), node);
    }
  sort_unique(nodes_);
}

Index NodesOnEdges::of(Index a, Index b) const {
  const Segment edge = ascending(Segment{a, b});
  const auto found = std::lower_bound(nodes_.begin(), nodes_.end(), edge,
                                      [](const auto& entry, const Segment& e) { return entry.first < e; });
  return found != nodes_.end() && found->first == edge ? found->second : no_entity;
}

void NodesOnEdges::add_facet(MeshData& mesh, const Triangle& facet, int marker) const {
  const std::array<Index, 3> mids{of(facet[0], facet[1]), of(facet[1], facet[2]), of(facet[0], facet[2])};
  if (std::find(mids.begin(), mids.end(), no_entity) != mids.end()) return mesh.add_facet(facet, marker);
  add_second_order(mesh, facet, mids, marker);
}

}  // namespace holdfast::io
