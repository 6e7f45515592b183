// Inserts points into a Delaunay triangulation (Bowyer 1981, Watson 1981): walk to a cell in conflict, dig
// the cavity round it, join its boundary to the point.
//
// The layout and the reconnection through a small table of local vertices follow the ideas of HXT
// (Marot, Pellerin, Remacle 2019), and so does the way in which several inserters work at a time (slab.h).
#pragma once

#include <cstdint>

#include "delaunay/boundary.h"
#include "delaunay/cavity.h"
#include "delaunay/links.h"
#include "delaunay/slab.h"
#include "delaunay/slots.h"
#include "delaunay/triangulation.h"

namespace holdfast {

/// Random numbers in a few instructions (Marsaglia 2003, xorshift), for the walk.
class Xorshift {
 public:
  explicit Xorshift(std::uint64_t odd_seed) : state_(odd_seed) {}
  std::uint32_t operator()() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return static_cast<std::uint32_t>(state_ >> 32);
  }

 private:
  std::uint64_t state_;
};

class Inserter {
 public:
  /// Number `index` of the inserters of a triangulation that has been started.
  Inserter(Triangulation& triangulation, unsigned index, std::uint64_t seed)
      : triangulation_(triangulation),
        own_(triangulation),
        random_((seed + index) * 2 + 1),
        slots_(triangulation),
        boundary_(triangulation.ghost() + index) {}

  /// Inserts vertex k, above all vertices that stand. A duplicate changes nothing. No other inserter runs.
  void insert(Vertex k);
  /// The same where vertices above k may stand.
  void insert_late(Vertex k);
  /// Inserts vertex k of the own slab while others work in theirs, or returns false.
  bool insert_in_slab(Vertex k);

  /// Looks for a cell near vertex k of the slab from which to start walks in the slab; no other inserter
  /// runs. False if there is none; then nothing can be inserted.
  bool enter(const Slab& slab, Vertex k, Tet from);
  /// Of the cavity of the last point.
  [[nodiscard]] std::size_t faces() const { return cavity_.rim().size(); }
  /// A cell that stands, from which to walk.
  [[nodiscard]] Tet last() const { return last_; }
  void set_last(Tet t) { last_ = t; }
  /// Marks the slots that were never used as free.
  void give_slots_back() { slots_.give_back(); }

 private:
  struct Located {
    Tet tet;
    enum { conflict, corner, outside_slab } what;
  };

  [[nodiscard]] const double* at(Vertex v) const { return triangulation_.at(v); }
  template <Insertion kMode>
  bool insert_as(Vertex k);
  template <bool kInSlab>
  [[nodiscard]] Located locate(const double* q);
  void note_duplicate(Tet t, Vertex k);
  void fill(Vertex k);
  void set_geometry(Vertex k);

  Triangulation& triangulation_;
  Ownership own_;
  Tet last_ = 0;
  Xorshift random_;
  Slots slots_;
  ConflictCavity cavity_;  // of the last point, as is its boundary
  CavityBoundary boundary_;
  EdgeLinks links_;
};

}  // namespace holdfast
