// Sizes or metrics given at the vertices of a background mesh, linear in each of its tetrahedra: metrics by
// their logarithms.
#pragma once

#include <optional>
#include <vector>

#include "holdfast/io.h"

namespace holdfast {

/// Finds the tetrahedron by a grid of buckets. Floating point is exact enough for a size.
class Background {
 public:
  /// Only the vertices and tetrahedra of the field count, which are finite and in range.
  explicit Background(SizeField field);

  struct Place {
    const Tetrahedron& tetrahedron;
    std::array<double, 4> parts;  ///< the weights of its corners
  };
  /// Where p is; nothing outside.
  [[nodiscard]] std::optional<Place> locate(const Point& point) const;

  /// Linear, and between those of the corners.
  [[nodiscard]] double size_at(const Place& place) const;
  [[nodiscard]] const Metric& metric(Index vertex) const { return field_.metrics[vertex]; }

 private:
  [[nodiscard]] std::size_t bucket_along(double x, std::size_t axis) const;
  template <typename Visit>
  void visit_buckets(const Tetrahedron& t, Visit&& visit) const;
  [[nodiscard]] std::optional<Place> place_in(const Tetrahedron& t, const Point& p) const;

  [[nodiscard]] Point scaled(const Point& p) const {
    return {p[0] * scale_[0], p[1] * scale_[1], p[2] * scale_[2]};
  }

  SizeField field_;  // its vertices times scale_
  Point scale_{};    // powers of two that bring each axis to [-1, 1]: ratios of volumes stay the same
  Point low_{}, step_{};
  std::array<std::size_t, 3> count_{1, 1, 1};
  std::vector<std::size_t> first_;  // of each bucket, in tets_
  std::vector<Index> tets_;
};

}  // namespace holdfast
