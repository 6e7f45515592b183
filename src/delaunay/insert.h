// The incremental Delaunay kernel (Bowyer 1981, Watson 1981) on cells that carry their spheres.
//
// The layout and the reconnection through a small table of local vertices follow the ideas of HXT
// (Marot, Pellerin, Remacle 2019). Vertices are numbered in the order of insertion, so that the youngest
// corner of a cell, its base, is near in memory to the points that come next; number n is the ghost.
//
// Degenerate input. A cell is in conflict with p iff p is strictly inside its open ball; a ghost, iff p
// is strictly beyond its hull face, or in the face's plane and strictly inside its circumcircle. No
// perturbation is needed for the new cells to be strictly positive:
//  * Let f be a face between a cell s in conflict and a cell t that is not, and suppose p in f's plane.
//    Both balls (half-spaces) cut the plane in f's circumdisc, so s and t are both in conflict or both
//    not: contradiction. If p were on t's side of f, then the power of p to t's ball would be at most
//    that to s's ball (they differ by a linear function that vanishes on f's plane and the triangulation
//    is Delaunay), hence t in conflict: contradiction. So p is strictly on s's side, and (f, p) is strictly
//    positive.
//  * The same for an edge between two ghosts, in place of the face: if p is in line with it, both discs
//    cut the line in the edge.
//  * Along the segment from any point of a cell in conflict to p the power of p to the cells met does
//    not grow, so the cells in conflict are connected and star-shaped with respect to p: the cavity's
//    boundary is a sphere on which every edge has two faces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/cell.h"
#include "delaunay/cell_store.h"
#include "holdfast/types.h"
#include "mesh/anatomy.h"

namespace holdfast {

class DelaunayKernel {
 public:
  /// `order` lists points; vertex k of the kernel is points[order[k]].
  DelaunayKernel(std::span<const Point> points, std::vector<std::uint32_t> order, std::uint64_t seed);

  /// Moves four points that span space to the front and makes their tetrahedron and its four ghosts.
  /// False if all points are coplanar.
  bool start();
  /// Number of points; the first four are inserted by start().
  [[nodiscard]] std::size_t size() const { return order_.size(); }
  /// Inserts vertex k; each once, in growing order. A duplicate changes nothing.
  void insert(Vertex k);

  [[nodiscard]] Vertex ghost() const { return ghost_; }
  [[nodiscard]] const CellStore& cells() const { return cells_; }
  /// Ends the insertions: moves cells into the free slots, so that none is left, and frees what only
  /// insert() needs.
  void finish();
  /// Frees the memory of the first `count` cells, which the caller has read for the last time.
  void forget_first(std::size_t count) { cells_.forget_first(count); }
  /// The point of each vertex: among equal points the first one.
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  struct alignas(32) Site {
    std::array<double, 3> x;
    std::uint32_t local;  // index in the cavity's boundary; valid if that entry names this vertex
  };
  // A face round the cavity, and the cell that comes to stand on it.
  struct BoundaryFace {
    Face outer;
    std::array<Vertex, 3> v;             // (new vertex, v) is positive
    std::array<std::uint32_t, 3> local;  // the same vertices as places in ring_
    Tet slot;
  };
  struct Located {
    Tet tet;
    bool conflict;  // else the point is a corner of the cell
  };

  [[nodiscard]] const double* at(Vertex v) const { return sites_[v].x.data(); }
  [[nodiscard]] bool is_ghost(const Cell& cell) const { return cell.v[3] == ghost_; }
  [[nodiscard]] bool in_conflict(const Cell& cell, const double* q) const {
    const Filtered test = filtered_conflict(cell, at(cell.v[0]), q[0], q[1], q[2]);
    return test.decided ? test.f < 0 : in_conflict_exact(cell, q);
  }
  [[nodiscard]] bool in_conflict_exact(const Cell& cell, const double* q) const;
  [[nodiscard]] Located locate(const double* q);
  void note_duplicate(Tet t, Vertex k);
  void dig(Tet seed, const double* q);
  void take_slots();
  void fill(Vertex k);
  template <bool kByTable>
  void list_boundary();
  void set_geometry(Vertex k);
  void set_geometry(Cell& cell);
  void link_by_table();
  void link_by_hash();
  std::uint32_t random();

  std::vector<std::uint32_t> order_;
  std::vector<Site> sites_;
  CellStore cells_;
  std::vector<Tet> free_;
  Vertex ghost_;
  Tet last_ = kNone;
  double diameter_ = 0;  // at least that of the point set
  std::uint64_t random_state_;

  // Of one insertion; kept to allocate nothing. The counts say how much of each array is in use.
  std::size_t cavity_count_ = 0;
  std::size_t face_count_ = 0;
  std::uint32_t ring_count_ = 0;
  std::vector<Face> cavity_;            // cells in conflict, by the face through which they were reached
  std::vector<Face> rim_;               // faces of the cavity's boundary, by their code inside
  std::vector<BoundaryFace> boundary_;  // the same in detail
  std::vector<Vertex> ring_;            // vertices of the boundary
  std::vector<Spoke> spokes_;           // the same, relative to the new vertex
  std::vector<Face> table_;             // new face at local edge (i, j)
  struct HashEntry {
    std::uint64_t key;
    Face face;
    std::uint32_t epoch;  // of the insertion that wrote the entry
  };
  std::vector<HashEntry> hash_;
  std::uint32_t epoch_ = 0;
};

}  // namespace holdfast
