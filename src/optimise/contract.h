// Removing one vertex by contraction onto a neighbour: too short edges go, and points in the way.
#pragma once

#include "optimise/contraction.h"
#include "optimise/volume.h"

namespace holdfast {

class VertexContractor {
 public:
  explicit VertexContractor(ImprovedVolume& volume) : volume_(volume), contraction_(volume) {}

  /// Contracts v onto the neighbour that makes the energy least, if that is less than before, and no edge
  /// becomes longer than `longest`. Where some edge at v is longer already, as beside large facets, sizes are
  /// not kept to whatever is done, and points in the way must be able to go: there edges may be some times as
  /// long. Returns the new tetrahedra, none where v stays.
  std::span<const Tet> contract(Vertex v, double longest);
  /// Of the last call, in tetrahedra looked at.
  [[nodiscard]] double work() const { return work_; }

 private:
  [[nodiscard]] double energy_with(Vertex w, double longest, double limit);

  ImprovedVolume& volume_;
  Contraction contraction_;
  double work_ = 0;
};

}  // namespace holdfast
