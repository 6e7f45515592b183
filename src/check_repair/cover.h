// Check of repairs: whether every point of an input facet lies near to the facets of the output.
//
// Let t be a triangle with corners A, B, C, D a distance, and K a set of triangles of the output whose
// corners lie within D of t. Take sums modulo 2. Let the boundary of K (the sides that an odd number of its
// triangles have) be the sum of three chains of edges of the output, one for each side of t, such that
//   (a) both ends of every edge of the chain of AB lie within D of AB, and
//   (b) the boundary of that chain is A' + B', where A' is a vertex of the output within D of A, and so on.
//   (c) The chains of AB and BC may have edges from B' to other vertices within D of B that are no edges of
//       the output, and likewise at A and C.
//   (d) K may have triangles uvw that are none of the output, if uv and uw are edges of it and u, v and w lie
//       within D - |vw| / 2 of t; or if they lie within h of one edge of the output, and within D - h of t.
//       Where v and w lie as near to AB, its chain may have the edge vw.
// Then every point of t lies within D of a point of K, of edges of the output in the chains, or of an end of
// one as in (c), A', B' and C' among them.
//
// Proof. Give each vertex of K its nearest point in t, and extend this linearly over K: f moves no point by
// more than D, since x - f(x) is a convex combination of such differences at corners. Do the same for the
// chain of AB with nearest points on AB: g. For an edge pq of the chain the homotopy from f to g sweeps a
// quadrilateral in t, all of whose points are images of points of pq and lie within D of these, again by
// convexity. At vertices these quadrilaterals cancel by (b), except for a path from f(A') to A twice, once
// for AB and once for CA. (If A' = B' and the chain is empty, the segment AB is swept from A' alone.)
// Altogether there is a chain in t, made of images that lie within D of what they are images of, with the
// boundary AB + BC + CA. The only such chain modulo 2 is t itself, so it covers t.
//
// Points of a triangle of (d), and of its edges, lie within |vw| / 2 of uv or uw, or within h of the one
// edge, since the distance to that is a convex function, too. Their images under f and g lie within D - |vw|
// / 2 or D - h of them, as above, and so within D of points of these edges.
//
// The argument holds for any K. So the search below may leave out some of the children that are named, where
// t was folded, add triangles of the output that are as thin as D, and use edges that are sides of no
// triangle of K, where thin parts of t became an edge. Larger triangles count only where they are named.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "check/box_tree.h"
#include "check_repair/reach.h"
#include "holdfast/types.h"

namespace holdfast::checking {

class CoverTest {
 public:
  /// All indices must exist, and the coordinates that they use be finite.
  CoverTest(std::span<const Point> vertices, std::span<const Triangle> facets)
      : vertices_(vertices), facets_(facets) {}
  CoverTest(std::span<const Point> vertices, std::span<const Triangle> facets, const Reach& reach)
      : CoverTest(vertices, facets) {
    set(reach);
  }

  /// The distance of the tests that follow; it must last as long as they do.
  void set(const Reach& reach) { reach_ = &reach; }

  /// Nothing if the facets of `chain` cover the triangle as above, else why that was not found. Each must be
  /// within reach. `places` are the vertices of the output that its corners became, or `no_entity`.
  [[nodiscard]] std::optional<std::string> gap(const std::array<Point, 3>& triangle,
                                               std::array<Index, 3> places, std::span<const Index> chain);

  /// The same for a segment and edges within reach of it.
  [[nodiscard]] std::optional<std::string> gap(const std::array<Point, 2>& segment,
                                               std::array<Index, 2> places, std::span<const Segment> chain);

 private:
  friend class Cover;
  [[nodiscard]] const BoxTree& tree();
  /// A used vertex within reach of a point, the given one if it is.
  [[nodiscard]] Index within_reach(const Point& p, Index vertex);
  /// The facets whose boxes come within reach of a box.
  template <class Visit>
  void near(Box box, Visit&& visit);

  std::span<const Point> vertices_;
  std::span<const Triangle> facets_;
  const Reach* reach_ = nullptr;
  std::optional<BoxTree> tree_;  // of the facets, once it is needed
};

}  // namespace holdfast::checking
