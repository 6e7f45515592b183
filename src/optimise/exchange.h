// Exchanges of tetrahedra for better ones: face swaps (2-3) and edge removals (3-2, 4-4, n to 2n-4), the best
// triangulation of each link found by dynamic programming.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/edge_removal.h"
#include "mesh/tet_mesh.h"
#include "optimise/badness.h"

namespace holdfast {

class Exchanger {
 public:
  Exchanger(TetMesh& mesh, double flat_from) : mesh_(mesh), flat_from_(flat_from) {}

  /// Makes the best of the ten exchanges at a tetrahedron, those of its six edges and four faces, if what
  /// comes is better than what goes. Constraints stand. `created` receives the new tetrahedra. Returns
  /// whether an exchange was made.
  bool improve(Tet t, std::vector<Tet>& created);

 private:
  void try_edge(Tet t, int edge);
  void try_face(Face f);
  void offer(const Badness& before, const Badness& after, std::span<const Tet> old_tets);

  TetMesh& mesh_;
  const double flat_from_;
  EdgeShell shell_;
  LinkTriangulation<Badness> triangulation_;
  std::vector<LinkTriangle> triangles_;
  std::vector<TetMesh::Corners> candidate_;
  // The best so far:
  std::ptrdiff_t fewer_flat_ = 0;
  double ratio_ = 0;  // worst Q after it over worst Q before it
  std::vector<TetMesh::Corners> fresh_;
  std::vector<Tet> old_;
};

}  // namespace holdfast
