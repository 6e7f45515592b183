// The points of an arrangement: the vertices of the complex and the points where its elements cross. Each
// place is there once, however it was found.
#pragma once

#include <span>
#include <vector>

#include "exact/packed_point.h"
#include "holdfast/types.h"
#include "surface/weld.h"

namespace holdfast::arrange {

/// Numbers 0 to n - 1 are the complex's vertices. The other points follow in the order in which they were
/// added.
class PointPool {
 public:
  /// `first`: for each vertex, the first vertex at its place (surface/places.h). The vertices must outlive
  /// the pool.
  PointPool(std::span<const Point> vertices, std::span<const Index> first);

  /// The number of the point at this place; `nearest` are the doubles nearest to it.
  Index add(exact::PackedPoint point, const Point& nearest);

  [[nodiscard]] Index size() const { return static_cast<Index>(vertices_.size() + exact_.size()); }
  /// The number of points that are no vertices.
  [[nodiscard]] std::size_t added() const { return exact_.size(); }
  [[nodiscard]] bool is_vertex(Index p) const { return p < vertices_.size(); }
  [[nodiscard]] std::span<const Point> coordinates() const { return vertices_; }
  /// Of a point that is no vertex.
  [[nodiscard]] exact::SpacePoint exact(Index p) const { return exact_[p - vertices_.size()].point(); }
  /// Of any point.
  [[nodiscard]] const Point& nearest(Index p) const {
    return is_vertex(p) ? vertices_[p] : nearest_[p - vertices_.size()];
  }
  /// Sign of p - q in lexicographic order.
  [[nodiscard]] int compare(Index p, Index q) const;

  std::vector<exact::PackedPoint> take_exact() { return std::move(exact_); }
  std::vector<Point> take_nearest() { return std::move(nearest_); }

 private:
  [[nodiscard]] bool is_at(Index p, const exact::SpacePoint& point) const;

  std::span<const Point> vertices_;
  std::vector<exact::PackedPoint> exact_;
  std::vector<Point> nearest_;
  PlaceTable table_;         // by nearest doubles, the first point with these
  std::vector<Index> next_;  // by point, the next one with the same nearest doubles
};

}  // namespace holdfast::arrange
