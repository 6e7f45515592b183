// Inserts points into a Delaunay triangulation (Bowyer 1981, Watson 1981).
//
// The layout and the reconnection through a small table of local vertices follow the ideas of HXT
// (Marot, Pellerin, Remacle 2019), and so does the way in which several inserters work at a time: space is
// cut into slabs, one an inserter. An inserter owns the vertices of its slab, and the cells all of whose
// vertices it owns (the ghost is everybody's). It changes no other cell but for the neighbour codes at faces
// of its own; a point whose cavity holds a cell that it does not own is left for later. So nothing is locked,
// and what is read is written by no other thread:
//  * corners, sphere and mark of a cell with an own vertex: only its owner changes them, and nobody else can
//  be
//    that; the walk stays on such cells, and the cavity and the cells next to it are of this kind;
//  * the neighbour code at a face with an own vertex: it changes only if all the face's vertices are of one
//    owner, which can be nobody else;
//  * the scratch of a vertex round a cavity: the vertices of a cell owned.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "delaunay/triangulation.h"

namespace holdfast {

/// A part of space: all points with low <= x[axis] < high.
struct Slab {
  std::size_t axis = 0;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  [[nodiscard]] bool holds(const double* x) const { return (low <= x[axis]) & (x[axis] < high); }
};

class Inserter {
 public:
  /// Number `index` of the inserters of a triangulation that has been started.
  Inserter(Triangulation& triangulation, unsigned index, std::uint64_t seed);

  /// Inserts vertex k, above all vertices that stand. A duplicate changes nothing. No other inserter runs.
  void insert(Vertex k);
  /// The same where vertices above k may stand.
  void insert_late(Vertex k);
  /// Inserts vertex k of the own slab while others work in theirs, or returns false.
  bool insert_in_slab(Vertex k);

  /// Looks for a cell next to the slab from which to walk in it, near vertex k of the slab; no other inserter
  /// runs. False if there is none, and then nothing can be inserted.
  bool enter(const Slab& slab, Vertex k, Tet from);
  /// Of the cavity of the last point.
  [[nodiscard]] std::size_t faces() const { return face_count_; }
  /// A cell that stands, from which to walk.
  [[nodiscard]] Tet last() const { return last_; }
  void set_last(Tet t) { last_ = t; }
  /// Marks the slots that were never used as free.
  void give_slots_back();

 private:
  // What may stand, and who else works.
  enum class Mode { in_order, late, in_slab };
  // A face round the cavity, and the cell that comes to stand on it.
  struct BoundaryFace {
    Face outer;
    std::array<Vertex, 3> v;             // (new vertex, v) is positive
    std::array<std::uint32_t, 3> local;  // the same vertices as places in ring_
    Tet slot;
  };
  struct Located {
    Tet tet;
    enum { conflict, corner, outside_slab } what;
  };

  [[nodiscard]] bool owns(Vertex v) const { return (v == ghost_) | slab_.holds(sites_[v].x.data()); }
  [[nodiscard]] bool owns_all(const Cell& cell) const;
  [[nodiscard]] bool touches(const Cell& cell) const;
  [[nodiscard]] const double* at(Vertex v) const { return sites_[v].x.data(); }
  template <Mode kMode>
  bool insert_as(Vertex k);
  template <bool kInSlab>
  [[nodiscard]] Located locate(const double* q);
  void note_duplicate(Tet t, Vertex k);
  template <Mode kMode>
  bool dig(Tet seed, const double* q, Vertex k);
  void restore_cavity();
  template <bool kGrow>
  bool find_slots();
  void take_slots();
  void fill(Vertex k);
  template <bool kByTable>
  void list_boundary();
  void set_geometry(Vertex k);
  void link_by_table();
  void link_by_hash();
  void turn_new_cells(Vertex k);
  void turn(Tet t);
  std::uint32_t random();

  Triangulation& triangulation_;
  Triangulation::Site* const sites_;
  const Vertex ghost_;
  const Vertex own_ghost_;  // place of the ghost's scratch
  Slab slab_;
  Tet last_ = 0;
  std::uint64_t random_state_;
  std::vector<Tet> free_;
  Tet next_slot_ = 0, end_slot_ = 0;  // of a block that was never used

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
