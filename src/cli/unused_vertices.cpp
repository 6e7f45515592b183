#include "unused_vertices.h"

#include <algorithm>
#include <limits>

#include "holdfast/holdfast.h"

namespace holdfast::cli {

std::vector<bool> in_use(const Surface& surface) {
  std::vector<bool> used(surface.vertices.size(), false);
  for (const Triangle& t : surface.facets)
    for (const Index v : t) used[v] = true;
  for (const Segment& s : surface.segments)
    for (const Index v : s) used[v] = true;
  return used;
}

std::size_t isolated_vertices(const Surface& surface) {
  const std::vector<bool> used = in_use(surface);
  if (std::find(used.begin(), used.end(), false) == used.end()) return 0;
  const std::vector<std::int64_t> map = vertex_map(surface.view());
  std::size_t count = 0;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (!used[v] && (map.empty() || map[v] >= 0)) ++count;
  return count;
}

std::vector<Point> without_unused(const Surface& surface) {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  std::vector<Point> vertices = surface.vertices;
  const std::vector<bool> used = in_use(surface);
  for (std::size_t v = 0; v < used.size(); ++v)
    if (!used[v]) vertices[v] = {kNowhere, kNowhere, kNowhere};
  return vertices;
}

}  // namespace holdfast::cli
