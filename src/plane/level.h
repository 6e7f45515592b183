// The plane of a polygon or facet in space, and its projection onto a coordinate plane.
//
// Floating point only measures: the mean plane, how far places lie from it, the coordinate plane least
// inclined to it. Exact signs decide whether places are coplanar or collinear, and ensure that no two places
// of a plane coincide in the projection.
#pragma once

#include <span>
#include <vector>

#include "holdfast/types.h"
#include "plane/sweep.h"

namespace holdfast::plane {

using Sides = std::vector<Ends>;

/// The places of corners in lexicographic order, so that nothing depends on the order of corners.
class Places {
 public:
  Places(std::span<const Point> vertices, std::span<const Index> corners);

  [[nodiscard]] std::size_t size() const { return index_.size(); }
  /// The first of the vertices at a place.
  [[nodiscard]] Index index(Vertex place) const { return index_[place]; }
  [[nodiscard]] const Point& at(Vertex place) const { return vertices_[index_[place]]; }
  [[nodiscard]] Vertex place_of(Index corner) const;
  [[nodiscard]] bool finite() const;

 private:
  std::span<const Point> vertices_;
  std::vector<Index> index_;
};

/// The sides of a closed walk, sorted.
[[nodiscard]] Sides sides_of(const std::vector<Vertex>& walk);

/// Whether a simple walk is clockwise, decided at its leftmost corner.
[[nodiscard]] bool turns_right(const std::vector<Position>& positions, const std::vector<Vertex>& walk);

/// Sign of the triangle abc, seen along an axis.
[[nodiscard]] int turn(const Point& a, const Point& b, const Point& c, std::size_t axis);

/// The plane of at least three places.
class Level {
 public:
  /// The mean plane is that of `sides` (Newell), through the mean place.
  Level(const Places& places, const Sides& sides, double tolerance);

  [[nodiscard]] bool straight() const { return straight_; }  ///< all places are collinear
  [[nodiscard]] bool flat() const { return flat_; }          ///< exactly
  [[nodiscard]] bool near() const { return near_; }          ///< within the tolerance, or rounding
  /// The same, or within the rounding of a file with six digits or single precision.
  [[nodiscard]] bool near_in_file() const { return near_in_file_; }
  /// The distance of the furthest place from the mean plane; 0 if rounding explains it.
  [[nodiscard]] double deviation() const { return deviation_ <= rounding_ ? 0 : deviation_; }
  [[nodiscard]] std::size_t axis() const { return axis_; }
  [[nodiscard]] Position project(const Point& p) const { return {p[(axis_ + 1) % 3], p[(axis_ + 2) % 3]}; }
  [[nodiscard]] const Point& normal() const { return normal_; }

 private:
  void find_base();
  [[nodiscard]] bool exactly_flat() const;
  void measure(const Sides& sides);
  void choose_axis();

  const Places& places_;
  Vertex third_ = 0;  // not collinear with the first two
  bool straight_ = false, flat_ = false, near_ = false, near_in_file_ = false;
  Point normal_{};
  double deviation_ = 0, rounding_ = 0, rounding_in_file_ = 0;
  std::size_t axis_ = 0;
};

}  // namespace holdfast::plane
