// The points given to a run: doubles, or points some of which are exact. They are not copied.
#pragma once

#include "plane/points.h"

namespace holdfast::plane {

class GivenPoints {
 public:
  // NOLINTBEGIN(google-explicit-constructor): either stands for points that are given
  GivenPoints(std::span<const Position> positions) : positions_(positions) {}
  GivenPoints(const std::vector<Position>& positions) : positions_(positions) {}
  GivenPoints(const Points& points)
      : positions_(points.positions()), exact_(points.all_explicit() ? nullptr : &points) {}
  // NOLINTEND(google-explicit-constructor)

  [[nodiscard]] std::size_t size() const { return positions_.size(); }
  [[nodiscard]] bool empty() const { return positions_.empty(); }
  /// The doubles, or the doubles nearest to exact points.
  [[nodiscard]] std::span<const Position> positions() const { return positions_; }
  [[nodiscard]] const Position& operator[](Vertex v) const { return positions_[v]; }
  /// Points some of which are exact, or null if all are doubles.
  [[nodiscard]] const Points* exact() const { return exact_; }

 private:
  std::span<const Position> positions_;
  const Points* exact_ = nullptr;
};

/// Points in another order, given by the former number of each point.
[[nodiscard]] Points in_order(const GivenPoints& given, std::span<const Vertex> order);

/// Adds one of the given points.
Vertex add(Points& points, const GivenPoints& given, Vertex v);

}  // namespace holdfast::plane
