// The regions that constraints separate from each other and from the outside.
#include "plane/regions.h"

#include <algorithm>

namespace holdfast::plane {
namespace {

/// Breadth first, so that the triangles of the queue can be fetched ahead.
void flood(const Triangles& mesh, std::uint32_t first, std::uint32_t region,
           std::vector<std::uint32_t>& of_triangle, std::vector<std::uint32_t>& queue) {
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

std::vector<Found> find_triangles(const Triangles& mesh, Points& points, std::span<const Position> places) {
  std::vector<Found> found(places.size());
  if (places.empty()) return found;
  const std::size_t before = points.size();
  // By x, so that each triangle looks at those within its own extent alone.
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < places.size(); ++i) {
    points.add(places[i]);
    order.emplace_back(places[i][0], i);
  }
  std::sort(order.begin(), order.end());
  for (std::uint32_t t = 0; t < mesh.size(); ++t) {
    if (mesh.is_ghost(t)) continue;
    const std::array<Vertex, 3>& v = mesh[t].v;
    const Position &a = points[v[0]], &b = points[v[1]], &c = points[v[2]];
    const double low = std::min({a[0], b[0], c[0]}), high = std::max({a[0], b[0], c[0]});
    auto it = std::lower_bound(order.begin(), order.end(), std::pair(low, std::size_t{0}));
    for (; it != order.end() && it->first <= high; ++it) {
      const double y = places[it->second][1];
      if (y < std::min({a[1], b[1], c[1]}) || y > std::max({a[1], b[1], c[1]})) continue;
      const auto p = static_cast<Vertex>(before + it->second);
      std::array<int, 3> side{};
      for (std::uint32_t i = 0; i < 3; ++i) side[i] = points.orient(v[(i + 1) % 3], v[(i + 2) % 3], p);
      if (side[0] < 0 || side[1] < 0 || side[2] < 0) continue;
      Found& result = found[it->second];
      result.triangle = t;
      for (std::uint32_t i = 0; i < 3; ++i) {
        if (side[i] != 0) continue;
        result.on_constraint |= (mesh[t].constrained >> i & 1) != 0;
      }
    }
  }
  points.shrink(before);
  return found;
}

}  // namespace holdfast::plane
