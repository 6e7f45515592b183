// The criteria of refinement: which constraints to cut, which triangles need a point, and where to put it.
// All measures are floating point, at the scale of the mesh.
#pragma once

#include "plane/growing_mesh.h"
#include "plane/refine.h"

namespace holdfast::plane {

class Criteria {
 public:
  Criteria(const GrowingMesh& growing, const RefineOptions& options);

  // --- Constraints

  /// Whether a constraint is too long, or its diametral circle contains the opposite corner.
  [[nodiscard]] bool must_cut(EdgeCode e) const;
  /// Whether a point at p would make constraint e need a cut. If the boundary is kept: whether it would make
  /// a triangle there with an angle below the bound and below those present or, if `for_size`, a flat one.
  [[nodiscard]] bool hurts(Vertex p, EdgeCode e, bool for_size) const;
  /// Points added for size keep a distance from all others, so their number is finite.
  [[nodiscard]] bool is_close(Vertex p, Vertex v) const {
    return squared(growing_.at(p), growing_.at(v)) < kClose * kClose * size2_;
  }

  // --- Triangles

  /// Whether the triangle exceeds a limit on size.
  [[nodiscard]] bool is_large(std::uint32_t t, const Shape& shape) const;
  /// Whether an angle is below the bound.
  [[nodiscard]] bool is_thin(const Shape& shape) const { return shape.cosine > bound_; }
  /// Whether the input forces the small angle, so that no point helps.
  [[nodiscard]] bool is_left_thin(std::uint32_t t, const Shape& shape) const {
    return is_across(t, shape) || (keep_boundary_ && is_between_constraints(t, shape));
  }
  /// The same at the end of the run, when an end of the shortest edge may also be a corner of the input.
  [[nodiscard]] bool is_thin_for_input(std::uint32_t t, const Shape& shape) const;

  // --- Places

  [[nodiscard]] bool has_size() const { return size2_ > 0; }
  [[nodiscard]] Position centre_of(std::uint32_t t) const;
  /// The point from which the shortest edge is seen under the bound, on the line from the middle of that edge
  /// to the circumcentre, if it is nearer than the circumcentre (Ungor).
  [[nodiscard]] Position off_centre(std::uint32_t t, const Shape& shape, const Position& centre) const;
  /// The middle of the longest edge that is no constraint.
  [[nodiscard]] Position middle_of_longest(std::uint32_t t, const Shape& shape) const;

 private:
  [[nodiscard]] bool encroaches(Vertex p, Vertex a, Vertex b) const {
    return dot_from(growing_.at(p), growing_.at(a), growing_.at(b)) <= 0;
  }
  [[nodiscard]] bool is_encroached(Vertex p, Vertex a, Vertex b) const;
  [[nodiscard]] bool is_across(std::uint32_t t, const Shape& shape) const;
  [[nodiscard]] bool is_between_constraints(std::uint32_t t, const Shape& shape) const;

  static constexpr double kClose = 0.4;  // of the size: the least distance from other points and constraints
  static constexpr double kSame = 0x1p-10;  // relative: distances that differ by rounding alone

  const GrowingMesh& growing_;
  double bound_;  // cosine of the least angle
  double off_;    // height of an off-centre over the length of its edge
  double size2_;  // square of the longest edge allowed, or 0
  std::vector<double> areas_;
  bool keep_boundary_;
};

}  // namespace holdfast::plane
