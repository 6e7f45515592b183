#include "refine/walls.h"

#include <algorithm>

#include "mesh/traverse.h"
#include "numbers/sorted.h"

namespace holdfast {

Walls::Walls(const TetMesh& mesh, std::span<const Tet> tets, Monitor& monitor) : sides_(mesh.vertex_count()) {
  for (const Tet t : tets) {
    monitor.poll_again();
    for (int i = 0; i < 4; ++i)
      if (const Face f = face_code(t, i); mesh.is_facet(f)) note_facet(mesh, f);
  }
  sort_unique(edges_);
}

void Walls::note_facet(const TetMesh& mesh, Face f) {
  const auto v = mesh.face_vertices(f);
  for (std::size_t i = 0; i < 3; ++i)
    for (const Vertex w : {v[(i + 1) % 3], v[(i + 2) % 3]}) edges_.push_back({v[i], w});
  const Point& p = mesh.position(v[0]);
  const Vector inward = cross(mesh.position(v[1]) - p, mesh.position(v[2]) - p);
  const double size = length(inward);
  if (!(size > 0)) return;
  for (std::size_t k = 0; k < Levels::kDirections; ++k) {
    const double along = dot(inward, Levels::direction(k)) / size;
    const auto bit = static_cast<std::uint16_t>(1U << k);
    for (const Vertex x : v) {
      if (along > Levels::kCone) sides_[x].floors |= bit;
      if (along < -Levels::kCone) sides_[x].ceilings |= bit;
    }
  }
}

std::span<const Walls::Edge> Walls::joined_to(Vertex v) const {
  const auto first = std::lower_bound(edges_.begin(), edges_.end(), Edge{v, 0});
  const auto last = std::find_if(first, edges_.end(), [v](const Edge& e) { return e[0] != v; });
  // By pointer and length: libc++ 13, of the package for browsers, has no other constructor.
  return {edges_.data() + (first - edges_.begin()), static_cast<std::size_t>(last - first)};
}

namespace {

using Counts = std::vector<std::uint8_t>;  // by vertex; at most as many as layers

// Counts edges to the nearest `first` vertex, over the vertices to which `for_each_next` leads.
template <typename IsFirst, typename ForEachNext>
Counts count_edges(std::size_t vertex_count, std::span<const Vertex> vertices, std::uint8_t most,
                   Monitor& monitor, const IsFirst& is_first, const ForEachNext& for_each_next) {
  Counts count(vertex_count, most);
  std::vector<Vertex> front, next;
  for (const Vertex v : vertices)
    if (is_first(v)) {
      count[v] = 0;
      front.push_back(v);
    }
  for (std::uint8_t far = 1; far < most && !front.empty(); ++far, front.swap(next)) {
    next.clear();
    for (const Vertex v : front) {
      monitor.poll_again();
      for_each_next(v, [&](Vertex w) {
        if (count[w] <= far) return;
        count[w] = far;
        next.push_back(w);
      });
    }
  }
  return count;
}

}  // namespace

bool number_levels(const VolumeData& volume, RegionId region, const Walls& walls,
                   std::span<const Vertex> vertices, std::size_t k, std::uint8_t layers, Levels& levels,
                   std::vector<std::uint8_t>& at_rims, Monitor& monitor) {
  TetMesh& mesh = volume.mesh;
  const auto floor = [&](Vertex v) { return walls.is_floor(v, k); };
  const auto ceiling = [&](Vertex v) { return walls.is_ceiling(v, k); };
  if (std::none_of(vertices.begin(), vertices.end(), floor) ||
      std::none_of(vertices.begin(), vertices.end(), ceiling))
    return false;
  // Along vertices that are neither.
  const auto along_facets = [&](const auto& is_first) {
    return count_edges(mesh.vertex_count(), vertices, layers, monitor, is_first,
                       [&](Vertex v, const auto& act) {
                         if (is_first(v) || !(floor(v) || ceiling(v)))
                           for (const Walls::Edge& e : walls.joined_to(v)) act(e[1]);
                       });
  };
  Counts up = along_facets(floor), down = along_facets(ceiling);
  std::vector<std::uint8_t> is_free(mesh.vertex_count(), 0);
  for (const Vertex v : vertices) {
    const bool is_at_rim = up[v] + down[v] < layers;
    is_free[v] = is_at_rim || walls.is_both(v, k) ? 1 : 0;
    if (is_at_rim) at_rims[v] = 1;
  }
  std::vector<Tet> tets;
  const auto inside = [&](const auto& is_first) {
    const auto is_counted = [&](Vertex v) { return is_free[v] == 0 && is_first(v); };
    return count_edges(mesh.vertex_count(), vertices, layers, monitor, is_counted,
                       [&](Vertex v, const auto& act) {
                         tets.clear();
                         ball(mesh, v, tets);
                         for (const Tet t : tets)
                           if (!mesh.is_ghost(t) && volume.region_of[t] == region)
                             for (const Vertex w : mesh.corners(t))
                               if (is_free[w] == 0) act(w);
                       });
  };
  const Counts inner_up = inside(floor), inner_down = inside(ceiling);
  for (const Vertex v : vertices) {
    const bool on_surface = walls.is_on_surface(v);
    const unsigned to_floor = on_surface ? up[v] : inner_up[v];
    const unsigned all = to_floor + (on_surface ? down[v] : inner_down[v]);
    levels[v][k] = is_free[v] != 0 ? Levels::kFree
                                   : static_cast<std::uint8_t>((2U * layers * to_floor + all) / (2 * all));
  }
  return true;
}

}  // namespace holdfast
