// The cells in conflict with a point, and the faces round them.
#pragma once

#include <span>
#include <vector>

#include "delaunay/slab.h"
#include "delaunay/triangulation.h"

namespace holdfast {

/// Which vertices may be in the triangulation when a vertex is inserted: only lower ones, any, or any while
/// other inserters work in their slabs.
enum class Insertion { in_order, late, in_slab };

/// Its cells are marked: the sign bit of `reach` is set.
class ConflictCavity {
 public:
  ConflictCavity();

  /// Collects the cells in conflict with q, vertex k, from one of them on; false if one of them is not owned.
  template <Insertion kMode>
  bool dig(Triangulation& triangulation, const Ownership& own, Tet seed, const double* q, Vertex k);
  /// Removes the marks.
  void restore(Triangulation& triangulation) const;

  /// The cells, by the face through which each was reached.
  [[nodiscard]] std::span<const Face> cells() const { return {cells_.data(), cell_count_}; }
  /// The faces round the cells, by their code inside.
  [[nodiscard]] std::span<const Face> rim() const { return {rim_.data(), face_count_}; }

 private:
  // Kept to allocate nothing. The counts say how much of each array is in use.
  std::vector<Face> cells_, rim_;
  std::size_t cell_count_ = 0, face_count_ = 0;
};

}  // namespace holdfast
