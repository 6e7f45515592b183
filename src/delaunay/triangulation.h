// The Delaunay triangulation during construction: points, cells, and the test for conflicts. One or several
// inserters (insert.h) change it.
//
// Vertices are numbered in the order of insertion, so that the youngest corner of a cell, its base, is near
// in memory to the points that come next; number n is the ghost. Corner 0 of every cell is its highest
// vertex that is no ghost.
//
// Degenerate input. Points are lifted to the paraboloid, vertex k a little lower than that by e(k), where
// 0 < e(0) << e(1) << ...: symbolically, so that the last of five cospherical vertices decides, and where
// its term vanishes the one before (simulation of simplicity; Edelsbrunner, Muecke 1990). The lower hull of
// the lifted points is then unique, has no vertical facet and misses no point, since the paraboloid is
// strictly convex. So the triangulation depends on the numbering alone, not on the order in which vertices
// are inserted, and all its cells are strictly positive. When they are inserted in their order, the new
// vertex always decides: p is in conflict with a cell iff it is inside its closed ball; with a ghost, iff it
// is strictly beyond the hull face, or in the face's plane and inside its closed circumcircle.
//
// Lower, not higher: then the last of any number of cospherical vertices is joined to all the others (a
// pulling triangulation), which makes as many tetrahedra as they have hull faces. With higher vertices the
// circles and spheres of a machine part would give the square of that.
//
// The cells in conflict with p are those whose lifted hyperplane is above the lifted p. Hence they are
// connected, every face round them is strictly visible from p, and the cells that join them to p are strictly
// positive.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/cell.h"
#include "delaunay/order.h"
#include "holdfast/types.h"
#include "mesh/anatomy.h"
#include "mesh/large_array.h"
#include "mesh/parallel.h"

namespace holdfast {

/// Slots first to end - 1.
struct SlotBlock {
  Tet first = 0, end = 0;
};

class Triangulation {
 public:
  struct alignas(32) Site {
    std::array<double, 3> x;
    std::uint32_t local;  // scratch of an inserter: place in its ring; valid if that entry names this vertex
    std::uint32_t cells;  // without the ghost, of which this is the highest vertex
  };

  /// Vertex k is points[order.points[k]]. `threads` is the number of inserters there can be.
  Triangulation(std::span<const Point> points, InsertionOrder order, const Threads& threads);

  /// Moves four points that span space to the front and makes their tetrahedron and its four ghosts.
  /// False if all points are coplanar.
  bool start();

  /// Number of points; the first four are inserted by start().
  [[nodiscard]] std::size_t size() const { return order_.points.size(); }
  [[nodiscard]] Vertex ghost() const { return ghost_; }
  [[nodiscard]] const double* at(Vertex v) const { return sites_[v].x.data(); }
  [[nodiscard]] bool is_ghost(const Cell& cell) const { return cell.v[3] == ghost_; }
  /// The point of each vertex: among equal points the first one; and the ends of the rounds.
  [[nodiscard]] const InsertionOrder& order() const { return order_; }
  /// Keeps the first of two equal points; `standing` is the one in the triangulation.
  void note_duplicate(Vertex standing, Vertex other);

  /// Free slots have the sign bit of `reach` set.
  [[nodiscard]] LargeArray<Cell>& cells() { return cells_; }
  [[nodiscard]] const LargeArray<Cell>& cells() const { return cells_; }
  /// Slots at the end of the array for `needed` cells or more; cells may move. No other inserter runs.
  SlotBlock grow_slots(std::size_t needed);
  /// The same while others run: none if expect_points() has not made enough room.
  SlotBlock claim_slots(std::size_t needed);
  /// Makes room for about as many more points, and afterwards for claim_slots().
  void expect_points(std::size_t count, unsigned inserters);
  /// Counts the claimed slots. Call this first when all inserters have ended.
  void settle_slots() { cells_.resize(claimed_); }
  /// After the points the ghost, once for each inserter.
  [[nodiscard]] Site* sites() { return sites_.data(); }
  /// Ends the insertions: frees memory that only insertions need.
  void drop_sites() { sites_.clear(); }
  [[nodiscard]] double diameter() const { return diameter_; }

  /// Whether vertex k, at q, is in conflict with a cell. `kInOrder`: k is above all vertices that stand.
  template <bool kInOrder>
  [[nodiscard]] bool in_conflict_exact(const Cell& cell, const double* q, Vertex k) const;
  /// Whether q is strictly inside the cell's ball, or strictly beyond a ghost's hull face; or may say so of a
  /// ghost where q is in conflict with it in the face's plane.
  [[nodiscard]] bool strictly_in_conflict(const Cell& cell, const double* q) const {
    const Filtered test = filtered_conflict(cell, at(cell.v[0]), q[0], q[1], q[2]);
    return test.decided ? test.f < 0 : conflict_sign(cell, q) > 0;
  }
  /// Sphere or half-space of a cell from its corners.
  void set_geometry(Cell& cell) const;

 private:
  void read_sites(std::span<const Point> points, const Threads& threads);
  template <typename Fits>
  bool choose(Vertex rank, const Fits& fits);
  void move_forward(Vertex from, Vertex to);
  void make_first_cells();
  [[nodiscard]] const Cell& sphere_of(const Cell& cell) const;
  [[nodiscard]] int conflict_sign(const Cell& cell, const double* q) const;
  [[nodiscard]] bool lowered_into_conflict(const Cell& cell, const double* q, Vertex k) const;

  InsertionOrder order_;
  LargeArray<Site> sites_;
  LargeArray<Cell> cells_;
  std::atomic<std::size_t> claimed_ = 0;  // slots in use, where cells_ does not count them yet
  Vertex ghost_;
  double diameter_ = 0;  // at least that of the point set
};

}  // namespace holdfast
