// Polygons of more than three corners, which some formats carry.
#include "io/polygon.h"

#include <algorithm>
#include <cmath>

#include "numbers/vector.h"

namespace holdfast::io {
namespace {

/// The corners relative to the first, scaled to size 1 so that products neither over- nor underflow.
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

}  // namespace

std::vector<Index> without_repeats(std::span<const Point> vertices, std::span<const Index> corners) {
  std::vector<Index> distinct;
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (vertices[corners[i]] != vertices[corners[(i + corners.size() - 1) % corners.size()]])
      distinct.push_back(corners[i]);
  return distinct;
}

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
  // A straight corner next to the apex would make a flat triangle with it.
  std::size_t apex = 0;
  while (apex < n && !(strict[(apex + n - 1) % n] && strict[(apex + 1) % n])) ++apex;
  if (apex == n) return {};
  std::vector<Triangle> triangles;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const std::size_t b = (apex + i) % n, c = (apex + i + 1) % n;
    // Turning left everywhere is not enough: a pentagram does too.
    if (!(area(apex, b, c) > 0)) return {};
    triangles.push_back({corners[apex], corners[b], corners[c]});
  }
  return triangles;
}

}  // namespace holdfast::io
