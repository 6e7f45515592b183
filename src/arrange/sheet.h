// A sheet: overlapping facets of one plane, or a single facet. It is triangulated once, with all traces of
// other elements.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "arrange/crossings.h"
#include "arrange/point_pool.h"
#include "holdfast/types.h"
#include "numbers/random.h"
#include "plane/triangles.h"
#include "surface/complex.h"
#include "surface/elements.h"

namespace holdfast::arrange {

/// A straight line in the plane of a sheet: through two vertices of the complex, or the intersection with the
/// plane of a facet.
struct Line {
  std::array<Index, 2> vertices{no_index, no_index};
  Index facet = no_index;  ///< in Elements::all, if there are no vertices
};

/// A piece of a line, with its two ends, that must become edges.
struct Trace {
  std::array<Index, 2> ends;  ///< points of the pool
  Line line;
};

/// A point of the pool that is known to lie on the side of a facet opposite to one of its corners.
struct PointOnSide {
  Index point, facet;
  unsigned opposite;
};

/// What a sheet is made of; indices of facets are those of Elements::all.
struct SheetInput {
  std::span<const Index> facets;
  std::span<const Index> points;
  std::span<const Trace> traces;
  /// Points and ends of traces known to lie on sides; may be incomplete.
  std::span<const PointOnSide> on_sides;
  std::size_t most_crossings = SIZE_MAX;  ///< largest number of crossings of traces; more throw TooManyPoints
};

struct SheetTriangles {
  std::vector<Triangle> triangles;  ///< points of the pool, then of `points`; oriented as the first parent
  std::vector<Index> first_parent, parents;  ///< of each, in ascending order, as indices of Elements::all
  std::vector<CrossingPoint*> points;        ///< where traces cross: numbers from the pool's size on
  /// For a sheet of several facets: the points on each side of the facets, in order from end to end.
  std::vector<std::vector<Index>> sides;
  /// Whether the triangles are known to meet only in common vertices and edges when all points stand at their
  /// nearest doubles.
  bool fits_rounded = false;
};

/// Triangulates a sheet. Points on the sides of its facets must be among `points`. Crossings of traces are
/// found here.
[[nodiscard]] SheetTriangles triangulate(const SheetInput& input, const Complex& complex,
                                         const Elements& elements, const PointPool& pool,
                                         Crossings& crossings, const plane::Poll& poll);

}  // namespace holdfast::arrange
