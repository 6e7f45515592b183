// Delaunay refinement: adds points until triangles are well shaped and small enough.
//
// After J. Ruppert, "A Delaunay refinement algorithm for quality 2-dimensional mesh generation" (J.
// Algorithms 1995); G.L. Miller, S.E. Pav, N.J. Walkington, "When and why Ruppert's algorithm works" (12th
// International Meshing Roundtable, 2003), whose variant terminates for every input and every bound up to
// 26.45 degrees; and A. Ungor, "Off-centers" (LATIN 2004), which needs fewer points.
#pragma once

#include "plane/sweep.h"

namespace holdfast::plane {

struct RefineOptions {
  double angle = 0;                ///< least angle of a triangle, in degrees
  double size = 0;                 ///< longest edge allowed; 0: no limit
  std::vector<double> areas = {};  ///< largest area of a triangle, by its mark; 0: no limit
  bool keep_boundary = false;      ///< puts no point on constraints
  std::size_t most_points = 0;     ///< limit on added points
};

struct Refined {
  struct OnSegment {
    std::uint32_t segment;
    double where;  ///< position along the segment, which grows from its first end to the second
    Vertex point;
  };
  std::vector<OnSegment> on_segments;  ///< by segment, in order along each
  std::size_t inside = 0;              ///< added points not on a constraint
  std::size_t on_others = 0;           ///< added points on constraints that are no segments: the convex hull
  /// Triangles below the bound in, or across from, a small angle between segments.
  std::size_t small_input = 0;
  std::size_t small_left = 0;  ///< others below the bound
  std::size_t large_left = 0;  ///< triangles above the limits of size
  bool capped = false;         ///< stopped at `most_points`
};

/// Adds points to constrained Delaunay triangles that are bounded by constraints, not closed, and keeps them
/// constrained Delaunay. The `mark` of a triangle is its region, which new ones inherit. Points on a segment
/// are rounded to doubles, so its pieces are not exactly collinear; all triangles stay exactly positive.
[[nodiscard]] Refined refine(Triangles& mesh, Points& points, const std::vector<Ends>& segments,
                             const RefineOptions& options, const Poll& poll);

}  // namespace holdfast::plane
