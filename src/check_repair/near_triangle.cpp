#include "check_repair/near_triangle.h"

#include <algorithm>
#include <cmath>

namespace holdfast::checking {

unsigned NearTriangle::sides_of(Index v) {
  const auto [at, is_new] = sides_.try_emplace(v, 0);
  if (is_new) at->second = sides_of(reach_, v, v);
  return at->second;
}

unsigned NearTriangle::sides_of(const Reach& reach, Index v, Index w) const {
  unsigned sides = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto is_near = [&](Index u) {
      return reach.of_segment(vertices_[u], triangle_[i], triangle_[(i + 1) % 3]);
    };
    if (is_near(v) && (v == w || is_near(w))) sides |= 1U << i;
  }
  return sides;
}

bool NearTriangle::has_within(const Reach& reach, std::span<const Index> vertices) const {
  return std::all_of(vertices.begin(), vertices.end(),
                     [&](Index v) { return reach.of_triangle(vertices_[v], triangle_); });
}

std::optional<Reach> NearTriangle::reach_without(double part) const {
  if (!(part < reach_.distance())) return std::nullopt;
  return Reach(std::nextafter(reach_.distance() - part, 0.0));
}

/// A distance from an edge within which all corners surely lie, less than that of the test.
std::optional<double> NearTriangle::height_above(const Segment& edge, const Triangle& corners) const {
  const Point &a = vertices_[edge[0]], &b = vertices_[edge[1]];
  constexpr double kLeast = 0x1p-10;  // of the distance of the test
  double height = kLeast * reach_.distance();
  for (const Index v : corners) height = std::max(height, rough_distance(vertices_[v], {a, b, a}));
  while (height < reach_.distance()) {
    const Reach reach(height);
    if (std::all_of(corners.begin(), corners.end(),
                    [&](Index v) { return reach.of_segment(vertices_[v], a, b); }))
      return height;
    height *= 1.125;
  }
  return std::nullopt;
}

std::optional<Reach> NearTriangle::reach_beside(std::initializer_list<Segment> edges,
                                                const Triangle& corners) const {
  std::optional<double> least;
  for (const Segment& edge : edges)
    if (const std::optional<double> height = height_above(edge, corners);
        height && (!least || *height < *least))
      least = height;
  const std::optional<Reach> left = least ? reach_without(*least) : std::nullopt;
  return left && has_within(*left, corners) ? left : std::nullopt;
}

}  // namespace holdfast::checking
