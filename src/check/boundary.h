// Check: the boundary of a volume (the faces of one tetrahedron only), and how often tetrahedra cover
// the space beside it. This decides, exactly, whether tetrahedra overlap.
//
// Let all tetrahedra be positive, and each face that two of them share have them on opposite sides. Let
// B be the union of the boundary faces and c(x) the number of tetrahedra that hold x, for x on no face.
//
// (1) Along a path that avoids edges, c changes at boundary faces only, by one: at any other face one
//     tetrahedron is left and one entered. Edges are of codimension 2, so c is constant on every
//     component of space without B. It is 0 far away. Hence c(x) is, on any ray from x that avoids
//     edges, the number of boundary faces through which the ray leaves their tetrahedra minus the number
//     through which it enters. No other face needs to be looked at.
// (2) No two tetrahedra overlap if and only if c <= 1, that is, c = 1 just inside every boundary face:
//     every bounded component of space without B has some boundary face on its border.
// (3) Let B be embedded (its faces meet in common vertices and sides only). Turn about a side: c goes up
//     or down by one at each boundary face, as one comes in or out of its tetrahedron. If the faces
//     alternate in this, as two always do, c has one value just inside all of them. So it is one number
//     for all faces that are connected through such sides: one ray decides a whole sheet. (If they do not
//     alternate, c takes values that differ by two and cannot be right on all sheets at this side.)
// (4) If B is embedded and c <= 1, the tetrahedra form a simplicial complex: let x lie in the open faces
//     s and s' of tetrahedra t and t'. If s lies on no boundary face, the tetrahedra at s cover a
//     neighbourhood of x, so t' is one of them, and s = s'. Likewise for s'. Else both lie on boundary
//     faces, and s = s' as B is embedded. So hanging vertices and touching blocks are found as well.
//
// The point just inside a boundary face abc of a tetrahedron abcd is p = a + e(b-a) + e^2(c-a) + e^3(d-a)
// for every small enough e > 0. It is inside since other faces of B stay further away: those that do
// not hold a by a constant, those that have only a in common by O(e), ab or ac by O(e^2). The sign of an
// affine function at p is the first that is not zero of its signs at a, b, c, d. So p needs no
// coordinates, and the orientation predicates decide everything.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "check/box_tree.h"
#include "check/face_table.h"
#include "holdfast/types.h"

namespace holdfast::checking {

/// A point infinitesimally close to `points[0]`: points[0] + e (points[1] - points[0]) + e^2 (...). With
/// fewer than four points, two still smaller steps along y and z make it generic.
struct Germ {
  std::array<const double*, 4> points{};
  std::size_t count = 0;
  bool away = false;  ///< the last step leads away from the fourth point instead of to it

  [[nodiscard]] int side_of_line(const double* u, const double* v) const;  ///< in the projection along x
  [[nodiscard]] int side_of_plane(const double* u, const double* v, const double* w) const;
};

struct BoundaryFace {
  Triangle corners;  ///< counterclockwise from outside
  Index apex;        ///< the fourth vertex of its tetrahedron
  Index tetrahedron;
};

class Boundary {
 public:
  Boundary() = default;
  /// Tetrahedra must be positive and faces matched (see above).
  Boundary(const FaceTable& faces, std::span<const Tetrahedron> tetrahedra, std::span<const Point> vertices,
           Pulse& pulse);

  [[nodiscard]] const std::vector<BoundaryFace>& faces() const { return faces_; }

  /// Pairs of boundary faces that meet outside common vertices and sides; B is embedded if none.
  [[nodiscard]] std::vector<std::array<Index, 2>> crossing_pairs(Pulse& pulse) const;

  /// A face and the number of tetrahedra that cover the space just inside it.
  struct Cover {
    Index face;
    int count;
  };
  /// The cover of one face of each sheet of (3). B must be embedded.
  [[nodiscard]] std::vector<Cover> covers(Pulse& pulse) const;

  /// One face of each bounded region of space that no tetrahedron covers. The tetrahedra must not overlap.
  [[nodiscard]] std::vector<Index> voids() const;

  /// Whether no tetrahedron holds any point of the entity, except for the entity's own vertices and sides.
  /// The entity's vertices are vertices of the volume. False for degenerate entities. The tetrahedra must not
  /// overlap.
  [[nodiscard]] bool outside(const Triangle& facet) const;
  [[nodiscard]] bool outside(const Segment& segment) const;
  [[nodiscard]] bool outside(Index vertex) const;

 private:
  /// A side of boundary faces: its ends in order, and one of the faces.
  struct Side {
    Index low, high, face;
  };

  [[nodiscard]] const double* at(Index vertex) const { return vertices_[vertex].data(); }
  [[nodiscard]] std::array<const double*, 3> corners(Index face) const;
  [[nodiscard]] std::vector<Side> sorted_sides() const;
  [[nodiscard]] Germ beside(Index face, bool inside) const;
  [[nodiscard]] int crossing(Index face, const Germ& germ) const;
  [[nodiscard]] bool opens_turning(Index face, const Side& axis) const;
  void turn_sort(std::span<Side> fan) const;

  /// Signed crossings of the ray from `germ` with all faces.
  [[nodiscard]] int cross(const Germ& germ) const;
  /// The largest x coordinate of a face.
  [[nodiscard]] double reach(Index face) const;

  std::span<const Point> vertices_;
  std::vector<BoundaryFace> faces_;
  BoxTree tree_;
};

}  // namespace holdfast::checking
