// The segments of the input during refinement: the segment of each piece, where to cut, and the angles
// between segments.
#pragma once

#include <algorithm>

#include "plane/shape.h"
#include "plane/sweep.h"

namespace holdfast::plane {

inline constexpr std::uint32_t kNoSegment = ~std::uint32_t{0};

class InputSegments {
 public:
  /// `at` has the scaled positions of all points and must outlive this. Constraints on the border of the mesh
  /// that are not segments, the sides of the convex hull, are numbered after the segments.
  InputSegments(const Triangles& mesh, const std::vector<Position>& at, const std::vector<Ends>& segments);

  [[nodiscard]] const std::vector<Ends>& ends() const { return ends_; }
  /// Whether a segment is given in the input.
  [[nodiscard]] bool is_given(std::uint32_t s) const { return s < given_; }
  /// The segment on which a point was put, or kNoSegment.
  [[nodiscard]] std::uint32_t below(Vertex p) const { return below_[p]; }
  void put(Vertex p, std::uint32_t s) { below_[p] = s; }
  void resize(std::size_t points) { below_.resize(points, kNoSegment); }
  /// The segment of which a constrained edge is a piece.
  [[nodiscard]] std::uint32_t of(Vertex a, Vertex b) const;

  /// Where to cut the edge ab: halfway, or at a power of two from a corner at one end where segments meet at
  /// less than 60 degrees.
  [[nodiscard]] Position cut_of(Vertex a, Vertex b) const;
  /// The corner that two segments have in common, or kNoVertex.
  [[nodiscard]] Vertex common_corner(std::uint32_t s, std::uint32_t r) const;
  /// Whether two segments meet at so small an angle that refinement leaves its inside alone: good triangles
  /// there would number as many as the inverse of the angle's sine, again and again towards the corner.
  [[nodiscard]] bool make_needle(std::uint32_t s, std::uint32_t r) const;
  /// The same for any two segments on which the points lie or which end in them.
  [[nodiscard]] bool any_make_needle(Vertex a, Vertex b) const;

 private:
  void list(const Triangles& mesh);
  void find_acute_corners();
  [[nodiscard]] bool is_acute(Vertex v) const { return v < acute_.size() && acute_[v]; }
  [[nodiscard]] Vertex other_end(std::uint32_t s, Vertex v) const {
    return ends_[s][ends_[s][0] == v ? 1 : 0];
  }
  template <typename Visit>
  void each_at(Vertex v, Visit&& visit) const;

  const std::vector<Position>& at_;
  std::vector<Ends> ends_;
  std::uint32_t given_;
  std::vector<std::uint32_t> below_;
  std::vector<std::pair<Ends, std::uint32_t>> by_ends_;
  std::vector<std::pair<Vertex, std::uint32_t>> at_corners_;  // segments at each corner of the input
  std::vector<bool> acute_;
};

}  // namespace holdfast::plane
