// Moves one vertex to where the sum of the energies of its ball is least.
#pragma once

#include <vector>

#include "optimise/star.h"
#include "optimise/volume.h"

namespace holdfast {

class VertexSmoother {
 public:
  explicit VertexSmoother(ImprovedVolume& volume) : volume_(volume) {}

  /// Moves v if that makes the energy of its ball less; every tetrahedron stays positive, decided exactly.
  /// A patient search descends along the gradient, too. Returns whether v was moved.
  bool smooth(Vertex v, bool patient);
  /// The ball of the last call.
  [[nodiscard]] const std::vector<Tet>& ball() const { return tets_; }

 private:
  void gather_star(Vertex v);
  bool settle(Vertex v, double before);
  [[nodiscard]] bool is_better(double before);

  ImprovedVolume& volume_;
  std::vector<Tet> tets_;
  Frame frame_;
  Star star_;                     // in the frame
  std::vector<double> energies_;  // of the ball
};

}  // namespace holdfast
