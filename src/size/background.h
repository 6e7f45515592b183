// Sizes or metrics given at the vertices of a background mesh, linear in each of its tetrahedra: metrics by
// their logarithms.
#pragma once

#include <optional>
#include <vector>

#include "holdfast/io.h"

namespace holdfast {

/// Finds the tetrahedron by a grid of buckets. Guesses in floating point are good enough for a size.
class Background {
 public:
  /// Only the vertices and tetrahedra of the field count.
  explicit Background(SizeField field);

  struct Place {
    const Tetrahedron& tetrahedron;
    std::array<double, 4> parts;  ///< the weights of its corners
  };
  /// Where p is; nothing outside.
  [[nodiscard]] std::optional<Place> locate(const Point& p) const;

  [[nodiscard]] const SizeField& field() const { return field_; }

 private:
  [[nodiscard]] std::size_t bucket_along(double x, std::size_t axis) const;
  template <typename Visit>
  void visit_buckets(const Tetrahedron& t, Visit&& visit) const;
  [[nodiscard]] std::optional<Place> place_in(const Tetrahedron& t, const Point& p) const;

  SizeField field_;
  Point low_{}, step_{};
  std::array<std::size_t, 3> count_{1, 1, 1};
  std::vector<std::size_t> first_;  // of each bucket, in tets_
  std::vector<Index> tets_;
};

}  // namespace holdfast
