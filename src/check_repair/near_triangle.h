// Check of repairs: what lies near a triangle and its sides.
#pragma once

#include <array>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>

#include "check_repair/reach.h"
#include "holdfast/types.h"

namespace holdfast::checking {

/// Sides are bits: bit i is the side from corner i to corner i + 1.
class NearTriangle {
 public:
  NearTriangle(std::span<const Point> vertices, const std::array<Point, 3>& triangle, const Reach& reach)
      : vertices_(vertices), triangle_(triangle), reach_(reach) {}

  /// The sides that are within reach of a vertex.
  [[nodiscard]] unsigned sides_of(Index v);
  /// The sides that are within a shorter reach of both vertices.
  [[nodiscard]] unsigned sides_of(const Reach& reach, Index v, Index w) const;
  [[nodiscard]] bool has_within(const Reach& reach, std::span<const Index> vertices) const;
  /// What remains of the distance after a part of it is used up; nothing if no distance remains.
  [[nodiscard]] std::optional<Reach> reach_without(double part) const;
  /// What remains of it for a triangle that is no facet, but near one of these edges; nothing if none is near
  /// enough. See (d) in cover.h.
  [[nodiscard]] std::optional<Reach> reach_beside(std::initializer_list<Segment> edges,
                                                  const Triangle& corners) const;
  /// |vw|, rounded up.
  [[nodiscard]] double width(Index v, Index w) const {
    return rough_distance(vertices_[v], vertices_[w]) * (1 + 0x1p-48);
  }

 private:
  [[nodiscard]] std::optional<double> height_above(const Segment& edge, const Triangle& corners) const;

  std::span<const Point> vertices_;
  const std::array<Point, 3>& triangle_;
  const Reach& reach_;
  std::map<Index, unsigned> sides_;
};

}  // namespace holdfast::checking
