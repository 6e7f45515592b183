// Surface layer: how two simplices of a complex meet, faces included.
//
// Two simplices fit if they meet in a common face or not at all, that is, if no face of one and a different
// face of the other have interiors that meet (intersect.h). `surely_fit` certifies nearly all neighbouring
// pairs of a good surface by a few signs. `contacts` looks at all pairs of faces and decides.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surface/intersect.h"

namespace holdfast {

/// The intersection of two simplices, a convex set.
struct Common {
  /// A corner of the intersection: faces of A and B, as masks, whose interiors meet in this point alone.
  /// Different touches are different points.
  struct Touch {
    unsigned a, b;
  };
  std::array<Touch, 2> touches{};
  unsigned count = 0;    ///< 0: disjoint; 1: a point; 2: a segment
  bool is_area = false;  ///< a polygon; then touches are not listed
};

/// Pairs of faces of two simplices A and B whose interiors meet. A face is a mask of corners (bit i:
/// corner i), and the pair (a, b) of masks is bit 8 a + b.
struct Contacts {
  std::uint64_t common = 0;    ///< pairs that are one simplex, by vertex index
  std::uint64_t distinct = 0;  ///< pairs of different simplices: each breaks the complex
  Common part;

  [[nodiscard]] static constexpr std::uint64_t bit(unsigned a, unsigned b) {
    return std::uint64_t{1} << (8 * a + b);
  }
};

/// True only if A and B are different and fit; false says nothing.
[[nodiscard]] bool surely_fit(const Simplex& a, const Simplex& b);

/// All pairs of faces that meet. A and B fit if and only if `distinct` is zero.
[[nodiscard]] Contacts contacts(const Simplex& a, const Simplex& b);

/// Corners of the intersection of A and B, rounded (error at most two units in the last place). None: A and B
/// are disjoint; one: a point; two: a segment; more: a polygon, in no particular order.
[[nodiscard]] std::vector<Point> common_corners(const Simplex& a, const Simplex& b);

}  // namespace holdfast
