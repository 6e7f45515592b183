// Polygons of more than three corners, and facets of several polygons.
//
// Floating point only chooses how to cut, or whether a facet counts as plane: whether a polygon that lies in
// no plane is convex, its mean plane, the coordinate plane that is least inclined to it, and areas. Exact
// signs decide whether a polygon lies in a plane, whether its projection keeps places distinct, and which
// triangles it gets there. `diagnose` then judges the triangles in space.
#include "plane/facets.h"

#include <algorithm>
#include <cmath>

#include "exact/predicates.h"
#include "numbers/vector.h"
#include "plane/least_area.h"
#include "plane/level.h"
#include "plane/polygon.h"
#include "text/decimal.h"

namespace holdfast::plane {
namespace {

/// The corners relative to the first, scaled to size 1 so that products neither overflow nor underflow.
std::vector<Point> local_corners(std::span<const Point> vertices, std::span<const Index> corners) {
  std::vector<Point> local;
  double size = 0;
  for (const Index corner : corners) {
    local.push_back(vertices[corner] - vertices[corners[0]]);
    for (const double x : local.back()) size = std::max(size, std::abs(x));
  }
  if (size > 0)
    for (Point& point : local)
      for (double& x : point) x /= size;
  return local;
}

/// The fan of triangles that covers a convex polygon, with its orientation; empty if the polygon, seen along
/// its mean normal, is not convex, or if every apex gives a flat triangle.
std::vector<Triangle> fan(std::span<const Point> vertices, std::span<const Index> corners) {
  const std::size_t n = corners.size();
  const std::vector<Point> local = local_corners(vertices, corners);
  Point normal{};  // Newell: the sum of the fan's vector areas, whatever the shape
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Point area = cross(local[i], local[i + 1]);
    for (std::size_t axis = 0; axis < 3; ++axis) normal[axis] += area[axis];
  }
  const auto area = [&](std::size_t a, std::size_t b, std::size_t c) {
    return dot(normal, cross(local[b] - local[a], local[c] - local[a]));
  };
  std::vector<bool> strict(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double turn = area((i + n - 1) % n, i, (i + 1) % n);
    if (!(turn >= 0)) return {};
    strict[i] = turn > 0;
  }
  // A straight corner next to the apex makes a flat triangle with it.
  std::size_t apex = 0;
  while (apex < n && !(strict[(apex + n - 1) % n] && strict[(apex + 1) % n])) ++apex;
  if (apex == n) return {};
  const std::size_t first = (apex + 1) % n;
  std::vector<Triangle> triangles;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const std::size_t b = (apex + i) % n, c = (apex + i + 1) % n;
    // A left turn everywhere is not enough: a pentagram has that, too. Nor are triangles that turn left, if
    // the polygon winds round its apex: then a corner lies to the right of the first one, seen from there.
    if (!(area(apex, b, c) > 0 && area(apex, first, c) >= 0)) return {};
    triangles.push_back({corners[apex], corners[b], corners[c]});
  }
  return triangles;
}

/// Whether triangles that are convex in floating point have one orientation, exactly, seen along the axis.
bool turn_alike(std::span<const Point> vertices, const std::vector<Triangle>& triangles, std::size_t axis) {
  const auto sign = [&](const Triangle& t) {
    return turn(vertices[t[0]], vertices[t[1]], vertices[t[2]], axis);
  };
  const int first = sign(triangles[0]);
  return first != 0 &&
         std::all_of(triangles.begin(), triangles.end(), [&](const Triangle& t) { return sign(t) == first; });
}

std::string not_plane(const Level& level) {
  return "that lies in no plane: its corners are up to " + decimal(level.deviation(), 3) +
         " away from the mean one; give a larger tolerance, or split it into triangles";
}

/// The places in the coordinate plane across an axis.
std::vector<Position> projected(const Places& places, std::size_t axis) {
  std::vector<Position> positions;
  positions.reserve(places.size());
  for (Vertex v = 0; v < places.size(); ++v) {
    const Point& p = places.at(v);
    positions.push_back({p[(axis + 1) % 3], p[(axis + 2) % 3]});
  }
  return positions;
}

std::vector<Triangle> in_space(const Places& places, const std::vector<Corners3>& flat) {
  std::vector<Triangle> triangles;
  triangles.reserve(flat.size());
  for (const Corners3& t : flat)
    triangles.push_back({places.index(t[0]), places.index(t[1]), places.index(t[2])});
  return triangles;
}

/// Triangles in the coordinate plane across an axis; none if places coincide there, or sides cross or
/// overlap.
std::vector<Triangle> triangles_across(const Places& places, const std::vector<Vertex>& walk,
                                       std::size_t axis, const Poll& poll) {
  const std::vector<Position> positions = projected(places, axis);
  std::vector<Position> sorted = positions;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return {};
  const auto flat = triangles_of_walk(positions, walk, poll);
  return flat ? in_space(places, *flat) : std::vector<Triangle>{};
}

/// A walk that begins at its first place from the left.
std::vector<Vertex> from_the_left(const std::vector<Vertex>& walk) {
  std::vector<Vertex> turned = walk;
  std::rotate(turned.begin(), std::min_element(turned.begin(), turned.end()), turned.end());
  return turned;
}

std::vector<Triangle> by_least_area(const Places& places, const std::vector<Vertex>& walk, const Poll& poll) {
  const std::vector<Vertex> turned = from_the_left(walk);
  std::vector<Point> points;
  points.reserve(turned.size());
  for (const Vertex place : turned) points.push_back(places.at(place));
  std::vector<Corners3> triangles = triangles_of_least_area(points, poll);
  for (Corners3& t : triangles) t = {turned[t[0]], turned[t[1]], turned[t[2]]};
  return in_space(places, triangles);
}

/// The corners without those at the place of their predecessor; the last corner precedes the first.
std::vector<Index> without_repeats(std::span<const Point> vertices, std::span<const Index> corners) {
  std::vector<Index> distinct;
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (vertices[corners[i]] != vertices[corners[(i + corners.size() - 1) % corners.size()]])
      distinct.push_back(corners[i]);
  return distinct;
}

std::vector<Triangle> fan_from_the_first(std::span<const Index> corners) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    triangles.push_back({corners[0], corners[i], corners[i + 1]});
  return triangles;
}

}  // namespace

CutPolygon cut_polygon(std::span<const Point> vertices, std::span<const Index> given, const Poll& poll) {
  const std::vector<Index> corners = without_repeats(vertices, given);
  if (corners.size() == 3) return {{{corners[0], corners[1], corners[2]}}};
  if (corners.size() < 3) return {{{given[0], given[1], given[2]}}};
  const Places places(vertices, corners);
  if (!places.finite() || places.size() < 3) return {fan_from_the_first(corners)};
  std::vector<Vertex> walk;
  walk.reserve(corners.size());
  for (const Index corner : corners) walk.push_back(places.place_of(corner));
  const Level level(places, sides_of(walk), 0);
  if (level.straight()) return {fan_from_the_first(corners)};
  std::vector<Triangle> triangles = fan(vertices, corners);
  if (!triangles.empty() && (!level.flat() || turn_alike(vertices, triangles, level.axis())))
    return {std::move(triangles), level.deviation()};
  const std::size_t axis = level.axis();
  triangles = triangles_across(places, walk, axis, poll);
  for (std::size_t k = 1; k < 3 && triangles.empty() && !level.near_in_file(); ++k)
    triangles = triangles_across(places, walk, (axis + k) % 3, poll);
  if (!triangles.empty()) return {std::move(triangles), level.deviation()};
  triangles = by_least_area(places, walk, poll);
  if (triangles.empty()) triangles = fan_from_the_first(corners);
  return {std::move(triangles), level.deviation(), true};
}

CutFacet cut_facet(std::span<const Point> vertices, const PolygonFacet& facet, double tolerance,
                   const Poll& poll) {
  std::vector<Index> corners;
  for (const std::vector<Index>& polygon : facet.polygons)
    corners.insert(corners.end(), polygon.begin(), polygon.end());
  const Places places(vertices, corners);
  if (!places.finite()) return {{}, "of which a corner is not finite", 0};
  if (places.size() < 3) return {{}, "of fewer than three places", 0};
  Sides edges, outline;
  std::vector<Vertex> first;
  for (const std::vector<Index>& polygon : facet.polygons) {
    std::vector<Vertex> walk;
    walk.reserve(polygon.size());
    for (const Index corner : polygon) walk.push_back(places.place_of(corner));
    if (polygon.size() >= 3 && first.empty()) first = walk;
    for (const auto& [a, b] : sides_of(walk))
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const Level level(places, sides_of(first), tolerance);
  if (level.straight()) return {{}, "whose corners lie on one line", 0};
  // Without holes, its polygons may lie separately, in planes that are close to each other.
  if (!(facet.holes.empty() ? level.near() : level.near_in_file())) return {{}, not_plane(level), 0};
  std::vector<Position> holes;
  for (const Point& hole : facet.holes) holes.push_back(level.project(hole));
  const std::vector<Position> positions = projected(places, level.axis());
  auto flat = triangles_of_outlines(positions, edges, holes, poll);
  if (!flat) return {{}, "whose sides cross or overlap, or have a hole on them", 0};
  if (flat->empty()) return {{}, "that encloses nothing, or nothing but holes", 0};
  if (turns_right(positions, first))
    for (Corners3& t : *flat) std::swap(t[1], t[2]);
  return {in_space(places, *flat), {}, level.deviation()};
}

}  // namespace holdfast::plane
