// Face swaps (2-3) and edge removals (3-2, 4-4, n to 2n-4) that make the energy less, the best triangulation
// of each link found by dynamic programming.
#pragma once

#include <vector>

#include "improve/volume.h"
#include "mesh/edge_removal.h"

namespace holdfast {

class EnergySwapper {
 public:
  explicit EnergySwapper(ImprovedVolume& volume) : volume_(volume) {}

  /// Makes the best of the ten exchanges at a tetrahedron if it makes the energy less. Constraints stand.
  /// With `as_worst`, only those where it is the worst element: the others are tried from there. Returns the
  /// new tetrahedra, none if there was no such exchange.
  std::span<const Tet> improve(Tet t, bool as_worst = false);

 private:
  struct Objective {
    using Cost = double;
    const ImprovedVolume& volume;
    const EdgeShell& shell;
    double before;

    static Cost none() { return 0; }
    static Cost join(Cost x, Cost y) { return x + y; }
    static bool better(Cost x, Cost y) { return x < y; }
    static Cost diagonal(std::size_t, std::size_t) { return 0; }
    [[nodiscard]] std::optional<Cost> triangle(std::size_t i, std::size_t k, std::size_t j) const;
  };

  void try_edge(Tet t, int edge);
  void try_face(Face f);
  void offer(double before, double after, std::span<const Tet> old_tets);

  ImprovedVolume& volume_;
  EdgeShell shell_;
  LinkTriangulation<double> triangulation_;
  std::vector<LinkTriangle> triangles_;
  std::vector<TetMesh::Corners> candidate_, fresh_;
  std::vector<Tet> old_;
  double gain_ = 0;
  double most_ = 0;  // the energy of an element that goes
};

}  // namespace holdfast
