// The vertices and cells that each of several inserters owns: space is cut into slabs, one for each inserter.
//
// An inserter owns the vertices of its slab, and the cells all of whose vertices it owns (the ghost is
// everybody's). It changes no other cell except the neighbour codes at its own faces; a point whose
// cavity holds a cell that it does not own is left for later. So nothing is locked, and what is read is
// written by no other thread:
//  * corners, sphere and mark of a cell with an own vertex: only its owner changes them, which no other
//    inserter can be; the walk stays on such cells, and the cavity and the cells next to it are of this kind;
//  * the neighbour code at a face with an own vertex: it changes only if one inserter owns all the
//    face's vertices, which no other one can;
//  * the scratch of a vertex round a cavity: it is a vertex of an owned cell.
// (The idea is that of HXT: Marot, Pellerin, Remacle 2019.)
#pragma once

#include <algorithm>
#include <limits>

#include "delaunay/triangulation.h"

namespace holdfast {

/// A part of space: all points with low <= x[axis] < high.
struct Slab {
  std::size_t axis = 0;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  [[nodiscard]] bool holds(const double* x) const { return (low <= x[axis]) & (x[axis] < high); }
};

/// What the inserter of a slab owns; at first all of space.
class Ownership {
 public:
  explicit Ownership(Triangulation& triangulation)
      : sites_(triangulation.sites()), ghost_(triangulation.ghost()) {}
  void move_to(const Slab& slab) { slab_ = slab; }

  [[nodiscard]] bool has(Vertex v) const { return (v == ghost_) | slab_.holds(sites_[v].x.data()); }
  [[nodiscard]] bool has_point(Vertex v) const { return v != ghost_ && has(v); }
  [[nodiscard]] bool has_all(const Cell& cell) const {
    return has(cell.v[0]) && has(cell.v[1]) && has(cell.v[2]) && has(cell.v[3]);
  }
  [[nodiscard]] bool touches(const Cell& cell) const {
    return std::any_of(cell.v.begin(), cell.v.end(), [&](Vertex v) { return has_point(v); });
  }

 private:
  const Triangulation::Site* sites_;
  Vertex ghost_;
  Slab slab_;
};

}  // namespace holdfast
