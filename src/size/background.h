// Sizes given at the vertices of a background mesh, linear in each of its tetrahedra.
#pragma once

#include <vector>

#include "holdfast/io.h"

namespace holdfast {

/// Finds the tetrahedron by a grid of buckets. Guesses in floating point are good enough for a size.
class Background {
 public:
  explicit Background(SizeField field);
  /// The size at p; 0 (no limit) outside.
  [[nodiscard]] double at(const Point& p) const;

 private:
  [[nodiscard]] std::size_t bucket_along(double x, std::size_t axis) const;
  template <typename Visit>
  void visit_buckets(const Tetrahedron& t, Visit&& visit) const;
  [[nodiscard]] bool interpolate(const Tetrahedron& t, const Point& p, double& size) const;

  SizeField field_;
  Point low_{}, step_{};
  std::array<std::size_t, 3> count_{1, 1, 1};
  std::vector<std::size_t> first_;  // of each bucket, in tets_
  std::vector<Index> tets_;
};

}  // namespace holdfast
