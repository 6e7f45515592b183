// Surface layer: triangles with a margin, and the axes that separate them.
#include "surface/round_triangle.h"

#include <algorithm>
#include <cmath>

#include "numbers/vector.h"

namespace holdfast {
namespace {

// Unit coordinates err by about 2^-52, sums of a few products by little more.
constexpr double kRoundings = 1e-13;
constexpr double kShortestAxis = 1e-250;

/// Of all points, the one with the largest value.
template <class Value>
Point farthest(const std::vector<std::array<Point, 3>>& corners, Value&& value) {
  Point best = corners[0][0];
  double most = value(best);
  for (const auto& t : corners)
    for (const Point& p : t)
      if (const double at = value(p); at > most) {
        most = at;
        best = p;
      }
  return best;
}

/// An upper bound on the distance of a point from a triangle: its distance from a point of the triangle that
/// is the nearest if it is inside, except for rounding.
double distance_above(const Point& p, const std::array<Point, 3>& corner, const Point& normal) {
  const std::array<Point, 3> way{corner[0] - p, corner[1] - p, corner[2] - p};
  std::array<double, 3> weight{};
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    weight[i] = std::max(0.0, dot(cross(way[(i + 1) % 3], way[(i + 2) % 3]), normal));
    sum += weight[i];
  }
  Point foot = corner[0];
  if (sum > 0) {
    foot = {0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) foot[k] += weight[i] / sum * corner[i][k];
  }
  return distance(p, foot);
}

}  // namespace

RoundTriangle::RoundTriangle(const std::vector<std::array<Point, 3>>& corners) {
  // The point of a triangle that is farthest from some place or line is a corner.
  Point &a = corner_[0], &b = corner_[1], &c = corner_[2];
  const auto square = [](const Point& v) { return dot(v, v); };
  a = farthest(corners, [&](const Point& p) { return square(p - corners[0][0]); });
  b = farthest(corners, [&](const Point& p) { return square(p - a); });
  c = farthest(corners, [&](const Point& p) { return square(cross(b - a, p - a)); });
  const Point normal = cross(b - a, c - a);
  for (const auto& t : corners)
    for (const Point& p : t) margin_ = std::max(margin_, distance_above(p, corner_, normal));
  margin_ += kRoundings;
  own_[3] = axis(normal);
  for (std::size_t i = 0; i < 3; ++i) {
    side_[i] = corner_[(i + 2) % 3] - corner_[(i + 1) % 3];
    own_[i] = axis(cross(side_[i], normal));
  }
}

RoundTriangle::Axis RoundTriangle::axis(const Point& direction) const {
  const auto [low, high] =
      std::minmax({dot(direction, corner_[0]), dot(direction, corner_[1]), dot(direction, corner_[2])});
  const double size = std::fabs(direction[0]) + std::fabs(direction[1]) + std::fabs(direction[2]);
  return {direction, size, low, high};
}

/// Whether the axis, one of this triangle, separates them. A comparison with NaN is false: "not sure". Nor is
/// anything sure along an axis so short that products with it underflow.
bool RoundTriangle::is_apart_along(const Axis& axis, const RoundTriangle& other) const {
  if (axis.size < kShortestAxis) return false;
  const double p = dot(axis.direction, other.corner_[0]), q = dot(axis.direction, other.corner_[1]),
               r = dot(axis.direction, other.corner_[2]);
  const double reach = (margin_ + other.margin_) * axis.size;
  return std::min(std::min(p, q), r) > axis.high + reach || std::max(std::max(p, q), r) < axis.low - reach;
}

bool surely_apart(const RoundTriangle& a, const RoundTriangle& b) {
  for (std::size_t i = 4; i-- > 0;)
    if (a.is_apart_along(a.own_[i], b) || b.is_apart_along(b.own_[i], a)) return true;
  for (const Point& side : a.side_)
    for (const Point& other : b.side_)
      if (a.is_apart_along(a.axis(cross(side, other)), b)) return true;
  return false;
}

}  // namespace holdfast
