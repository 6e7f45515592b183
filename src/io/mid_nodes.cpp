// Nodes on the edges of a file's elements, as MidNodes or dropped.
#include "io/mid_nodes.h"

#include <algorithm>
#include <utility>

namespace holdfast::io {
namespace {

constexpr std::array<Index, 6> kNoneOfTet{no_entity, no_entity, no_entity, no_entity, no_entity, no_entity};
constexpr std::array<Index, 3> kNoneOfFacet{no_entity, no_entity, no_entity};

template <std::size_t N>
void mark(std::vector<bool>& marks, const std::vector<std::array<Index, N>>& entities, bool value) {
  for (const auto& entity : entities)
    for (const Index v : entity)
      if (v != no_entity) marks[v] = value;
}

/// By vertex, whether it is a node of elements but a corner of none.
std::vector<bool> no_corners(const MeshData& mesh) {
  std::vector<bool> marks(mesh.vertices.size());
  mark(marks, mesh.mids.tetrahedra, true);
  mark(marks, mesh.mids.facets, true);
  for (const Index v : mesh.mids.segments)
    if (v != no_entity) marks[v] = true;
  for (const Index v : mesh.mids.others) marks[v] = true;
  mark(marks, mesh.tetrahedra, false);
  mark(marks, mesh.facets, false);
  mark(marks, mesh.segments, false);
  for (const plane::PolygonFacet& facet : mesh.polygons)
    for (const std::vector<Index>& polygon : facet.polygons)
      for (const Index v : polygon) marks[v] = false;
  return marks;
}

bool complete(const MeshData& mesh, const std::vector<bool>& on_edges) {
  const auto is_node = [&](Index v) { return v != no_entity && on_edges[v]; };
  const auto all = [&](const auto& nodes) { return std::all_of(nodes.begin(), nodes.end(), is_node); };
  return mesh.mids.others.empty() && mesh.mids.tetrahedra.size() == mesh.tetrahedra.size() &&
         mesh.mids.facets.size() == mesh.facets.size() && mesh.mids.segments.size() == mesh.segments.size() &&
         std::all_of(mesh.mids.tetrahedra.begin(), mesh.mids.tetrahedra.end(), all) &&
         std::all_of(mesh.mids.facets.begin(), mesh.mids.facets.end(), all) && all(mesh.mids.segments);
}

/// The nodes on edges of tetrahedra, by the ends of the edge.
class NodesOfEdges {
 public:
  explicit NodesOfEdges(const MeshData& mesh) {
    constexpr std::size_t kEnds[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
    nodes_.reserve(6 * mesh.tetrahedra.size());
    for (std::size_t t = 0; t < mesh.mids.tetrahedra.size(); ++t)
      for (std::size_t e = 0; e < 6; ++e)
        nodes_.push_back({ascending(mesh.tetrahedra[t][kEnds[e][0]], mesh.tetrahedra[t][kEnds[e][1]]),
                          mesh.mids.tetrahedra[t][e]});
    std::sort(nodes_.begin(), nodes_.end());
  }
  [[nodiscard]] Index on(Index a, Index b) const {
    const auto found = std::lower_bound(nodes_.begin(), nodes_.end(), std::pair(ascending(a, b), Index{0}));
    return found == nodes_.end() || found->first != ascending(a, b) ? no_entity : found->second;
  }

 private:
  static Segment ascending(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

  std::vector<std::pair<Segment, Index>> nodes_;
};

/// Gives triangles and segments without nodes those of the tetrahedra, where all of these have some: Netgen
/// writes none for segments.
void take_from_tetrahedra(MeshData& mesh) {
  MeshData::FileMids& mids = mesh.mids;
  if (mids.tetrahedra.empty() || mids.tetrahedra.size() < mesh.tetrahedra.size()) return;
  mids.facets.resize(mesh.facets.size(), kNoneOfFacet);
  mids.segments.resize(mesh.segments.size(), no_entity);
  const auto lacks = [](const auto& of) { return of[0] == no_entity; };
  if (std::none_of(mids.facets.begin(), mids.facets.end(), lacks) &&
      std::find(mids.segments.begin(), mids.segments.end(), no_entity) == mids.segments.end())
    return;
  const NodesOfEdges nodes(mesh);
  for (std::size_t f = 0; f < mids.facets.size(); ++f) {
    const Triangle& facet = mesh.facets[f];
    if (lacks(mids.facets[f]))
      mids.facets[f] = {nodes.on(facet[0], facet[1]), nodes.on(facet[1], facet[2]),
                        nodes.on(facet[0], facet[2])};
  }
  for (std::size_t s = 0; s < mids.segments.size(); ++s)
    if (mids.segments[s] == no_entity) mids.segments[s] = nodes.on(mesh.segments[s][0], mesh.segments[s][1]);
}

template <typename Entity>
void renumber(std::vector<Entity>& entities, const std::vector<Index>& number) {
  for (auto& entity : entities)
    for (Index& v : entity) v = number[v];
}

}  // namespace

void add_second_order(MeshData& mesh, const Tetrahedron& corners, const std::array<Index, 6>& mids,
                      int region) {
  mesh.mids.tetrahedra.resize(mesh.tetrahedra.size(), kNoneOfTet);
  mesh.mids.tetrahedra.push_back(mids);
  mesh.add_tetrahedron(corners, region);
}

void add_second_order(MeshData& mesh, const Triangle& corners, const std::array<Index, 3>& mids, int marker) {
  mesh.mids.facets.resize(mesh.facets.size(), kNoneOfFacet);
  mesh.mids.facets.push_back(mids);
  mesh.add_facet(corners, marker);
}

void add_second_order(MeshData& mesh, const Segment& corners, Index mid, int marker) {
  mesh.mids.segments.resize(mesh.segments.size(), no_entity);
  mesh.mids.segments.push_back(mid);
  mesh.add_segment(corners, marker);
}

void add_side(MeshData& mesh, Index tetrahedron, std::size_t opposite, int marker) {
  const Triangle facet = outward_face(mesh.tetrahedra[tetrahedron], opposite);
  if (tetrahedron >= mesh.mids.tetrahedra.size() || mesh.mids.tetrahedra[tetrahedron][0] == no_entity)
    return mesh.add_facet(facet, marker);
  constexpr std::size_t kEdge[4][4] = {{0, 0, 2, 3}, {0, 0, 1, 4}, {2, 1, 0, 5}, {3, 4, 5, 0}};
  const std::array<Index, 6>& mids = mesh.mids.tetrahedra[tetrahedron];
  const std::array<std::size_t, 3>& corners = outward_faces[opposite];
  const auto mid = [&](std::size_t i, std::size_t k) { return mids[kEdge[corners[i]][corners[k]]]; };
  add_second_order(mesh, facet, {mid(0, 1), mid(1, 2), mid(0, 2)}, marker);
}

void add_no_corners(MeshData& mesh, std::span<const Index> nodes) {
  mesh.mids.others.insert(mesh.mids.others.end(), nodes.begin(), nodes.end());
}

void settle_mid_nodes(MeshData& mesh, bool keep) {
  if (mesh.mids.tetrahedra.empty() && mesh.mids.facets.empty() && mesh.mids.segments.empty() &&
      mesh.mids.others.empty())
    return;
  if (keep) take_from_tetrahedra(mesh);
  const std::vector<bool> on_edges = no_corners(mesh);
  keep = keep && complete(mesh, on_edges);
  const std::vector<int> markers = mesh.vertex_markers.take(mesh.vertices.size());
  mesh.vertex_markers = {};
  std::vector<Index> number(mesh.vertices.size());
  std::vector<Point> corners, mids;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (on_edges[v]) {
      mids.push_back(mesh.vertices[v]);
      continue;
    }
    number[v] = static_cast<Index>(corners.size());
    mesh.vertex_markers.add(corners.size(), tag_of(markers, v));
    corners.push_back(mesh.vertices[v]);
  }
  for (std::size_t v = 0, next = corners.size(); v < number.size(); ++v)
    if (on_edges[v]) number[v] = static_cast<Index>(next++);
  renumber(mesh.tetrahedra, number);
  renumber(mesh.facets, number);
  renumber(mesh.segments, number);
  for (plane::PolygonFacet& facet : mesh.polygons) renumber(facet.polygons, number);
  mesh.vertices = std::move(corners);
  if (!keep) {
    if (mesh.mids.others.empty())
      mesh.leave_out(mids.size(), "nodes in the middle of edges", "node in the middle of an edge");
    else
      mesh.leave_out(mids.size(), "nodes that are no corners", "node that is no corner");
  } else {
    renumber(mesh.mids.tetrahedra, number);
    renumber(mesh.mids.facets, number);
    for (Index& v : mesh.mids.segments) v = number[v];
    mesh.mid_nodes = {std::move(mids), std::move(mesh.mids.tetrahedra), std::move(mesh.mids.facets),
                      std::move(mesh.mids.segments)};
  }
  mesh.mids = {};
}

}  // namespace holdfast::io
