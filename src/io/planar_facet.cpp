#include "io/planar_facet.h"

#include <algorithm>
#include <cmath>

#include "holdfast/plane.h"
#include "io/polygon.h"
#include "numbers/vector.h"

namespace holdfast::io {
namespace {

/// Twice the vector area of an outline, relative to its size.
Point normal_of(const std::vector<Point>& vertices, const std::vector<Index>& outline) {
  double size = 0;
  for (const Index v : outline)
    for (const double x : vertices[v] - vertices[outline[0]]) size = std::max(size, std::abs(x));
  Point normal{};
  for (std::size_t i = 1; i + 1 < outline.size() && size > 0; ++i) {
    Point a = vertices[outline[i]] - vertices[outline[0]],
          b = vertices[outline[i + 1]] - vertices[outline[0]];
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] /= size;
      b[k] /= size;
    }
    const Point area = cross(a, b);
    for (std::size_t k = 0; k < 3; ++k) normal[k] += area[k];
  }
  return normal;
}

/// The two coordinates in which an outline turns left.
std::array<std::size_t, 2> projection_of(const Point& normal) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
  const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  return normal[axis] < 0 ? std::array{y, x} : std::array{x, y};
}

}  // namespace

bool needs_triangulation(const std::vector<Point>& vertices, const PlanarFacet& facet) {
  if (!facet.holes.empty()) return true;
  const auto is_outline = [](const std::vector<Index>& polygon) { return polygon.size() > 2; };
  const auto is_not_convex = [&](const std::vector<Index>& polygon) {
    const std::vector<Index> distinct = without_repeats(vertices, polygon);
    return distinct.size() > 3 && fan(vertices, distinct).empty();
  };
  const auto outlines =
      static_cast<std::size_t>(std::count_if(facet.polygons.begin(), facet.polygons.end(), is_outline));
  return outlines > 0 && (outlines < facet.polygons.size() ||
                          std::any_of(facet.polygons.begin(), facet.polygons.end(), is_not_convex));
}

void add_planar_facet(MeshData& mesh, const PlanarFacet& facet, const Limits& limits,
                      const std::function<void(const std::string&)>& fail) {
  Plane plane;
  std::vector<Index> corners;  // of the facet, each once
  for (const std::vector<Index>& polygon : facet.polygons)
    corners.insert(corners.end(), polygon.begin(), polygon.end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  const auto outline = std::find_if(facet.polygons.begin(), facet.polygons.end(),
                                    [](const auto& polygon) { return polygon.size() > 2; });
  if (outline == facet.polygons.end()) return fail("a facet with holes, but without an outline");
  const auto [x, y] = projection_of(normal_of(mesh.vertices, *outline));
  for (const Index v : corners) plane.points.push_back({mesh.vertices[v][x], mesh.vertices[v][y]});
  for (const Point& hole : facet.holes) plane.holes.push_back({hole[x], hole[y]});
  const auto number = [&](Index v) {
    return static_cast<Index>(std::lower_bound(corners.begin(), corners.end(), v) - corners.begin());
  };
  std::vector<Segment> sides;
  for (const std::vector<Index>& polygon : facet.polygons) {
    if (polygon.size() < 2) continue;
    const std::size_t count = polygon.size() == 2 ? 1 : polygon.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Index a = number(polygon[i]), b = number(polygon[(i + 1) % polygon.size()]);
      if (a != b) sides.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  // Outlines may share sides; each is one segment.
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  plane.segments = sides;
  PlaneOptions options;
  static_cast<Limits&>(options) = limits;
  const PlaneResult result = triangulate(plane, options);
  if (result.outcome != Outcome::done || result.mesh.triangles.empty())
    return fail("a facet whose outlines do not bound a part of its plane" +
                (result.message.empty() ? std::string() : ": " + result.message));
  for (const Triangle& t : result.mesh.triangles)
    mesh.add_facet({corners[t[0]], corners[t[1]], corners[t[2]]}, facet.marker);
  for (const std::vector<Index>& polygon : facet.polygons)
    if (polygon.size() == 2) mesh.add_segment({polygon[0], polygon[1]}, facet.marker);
  ++mesh.polygons_cut;
}

}  // namespace holdfast::io
