#include "recover/far_points.h"

#include <algorithm>
#include <array>

#include "delaunay/box.h"
#include "exact/predicates.h"
#include "numbers/vector.h"
#include "recover/tuning.h"

namespace holdfast {
namespace {

/// The plane of the facet, and a box round the cavity.
struct Level {
  std::array<Point, 3> p;
  std::array<Point, 8> box;
  Vector normal;
  double area, extent;

  Level(std::span<const Point> points, const Triangle& facet)
      : p{points[facet[0]], points[facet[1]], points[facet[2]]},
        box(box_corners(points, tuning::kCavityMargin)),
        normal(cross(p[1] - p[0], p[2] - p[0])),
        area(length(normal)),
        extent(distance(box[7], box[0])) {}

  [[nodiscard]] bool is_above(const Point& q) const {
    return exact::orient3d(p[0].data(), p[1].data(), p[2].data(), q.data()) > 0;
  }
  [[nodiscard]] double height(const Point& q) const { return dot(q - p[0], normal) / area; }
  [[nodiscard]] Point raised(const Point& q, double by) const {
    return {q[0] + by / area * normal[0], q[1] + by / area * normal[1], q[2] + by / area * normal[2]};
  }
};

std::vector<Point> far_points(std::span<const Point> points, const Level& level) {
  std::vector<Point> out;
  for (const Point& corner : level.box)
    if (level.is_above(corner)) out.push_back(corner);
  double lowest = level.extent;
  for (const Point& q : points)
    if (const double height = level.height(q); height > 0) lowest = std::min(lowest, height);
  const double depth =
      std::clamp(level.extent * level.extent / lowest, level.extent, tuning::kDeepest * level.extent);
  Point middle{};
  for (std::size_t k = 0; k < 3; ++k) middle[k] = (level.p[0][k] + level.p[1][k] + level.p[2][k]) / 3;
  out.push_back(level.raised(middle, -depth));
  return out;
}

}  // namespace

std::vector<Point> far_points(std::span<const Point> points, const Triangle& facet) {
  return far_points(points, Level(points, facet));
}

std::vector<Point> far_points_all_round(std::span<const Point> points, const Triangle& facet) {
  const Level level(points, facet);
  std::vector<Point> out = far_points(points, level);
  const double above = level.extent * tuning::kAboveFacet;
  for (const Point& corner : level.box) {
    const Point pressed = level.raised(corner, above - level.height(corner));
    if (level.is_above(pressed)) out.push_back(pressed);
  }
  return out;
}

}  // namespace holdfast
