// The regions that constraints separate from each other and from the outside.
#include "plane/regions.h"

#include "plane/point_tree.h"

namespace holdfast::plane {
namespace {

/// Breadth first, so the triangles in the queue can be prefetched.
void flood(const Triangles& mesh, std::uint32_t first, std::uint32_t region,
           LargeVector<std::uint32_t>& of_triangle, std::vector<std::uint32_t>& queue) {
  queue.assign(1, first);
  of_triangle[first] = region;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const Corners& corners = mesh[queue[next]];
    for (std::uint32_t i = 0; i < 3; ++i) {
      const EdgeCode other = corners.across[i];
      if (other == kNoEdge || (corners.constrained >> i & 1) != 0) continue;
      const std::uint32_t t = triangle_of(other);
      if (of_triangle[t] != kNoVertex) continue;
      of_triangle[t] = region;
      __builtin_prefetch(&mesh[t]);
      queue.push_back(t);
    }
  }
}

}  // namespace

Regions find_regions(const Triangles& mesh) {
  Regions regions;
  std::vector<std::uint32_t> queue;
  regions.of_triangle.assign(mesh.size(), kNoVertex);
  for (std::uint32_t t = 0; t < mesh.size(); ++t)
    if (mesh.is_ghost(t) && regions.of_triangle[t] == kNoVertex)
      flood(mesh, t, kOutside, regions.of_triangle, queue);
  for (std::uint32_t t = 0; t < mesh.size(); ++t)
    if (regions.of_triangle[t] == kNoVertex) flood(mesh, t, ++regions.count, regions.of_triangle, queue);
  return regions;
}

std::vector<Found> find_triangles(const Triangles& mesh, Points& points, const GivenPoints& places) {
  std::vector<Found> found(places.size());
  if (places.empty()) return found;
  const std::size_t before = points.size();
  std::vector<Vertex> vertices;
  for (Vertex i = 0; i < places.size(); ++i) vertices.push_back(add(points, places, i));
  const PointTree tree(points, vertices);
  for (std::uint32_t t = 0; t < mesh.size(); ++t) {
    if (mesh.is_ghost(t)) continue;
    const std::array<Vertex, 3>& v = mesh[t].v;
    tree.each_near(v[0], v[1], v[2], [&](std::uint32_t item) {
      std::array<int, 3> side{};
      for (std::uint32_t i = 0; i < 3; ++i)
        side[i] = points.orient(v[(i + 1) % 3], v[(i + 2) % 3], vertices[item]);
      if (side[0] < 0 || side[1] < 0 || side[2] < 0) return true;
      Found& result = found[item];
      result.triangle = t;
      for (std::uint32_t i = 0; i < 3; ++i)
        if (side[i] == 0) result.on_constraint |= (mesh[t].constrained >> i & 1) != 0;
      return true;
    });
  }
  points.shrink(before);
  return found;
}

}  // namespace holdfast::plane
