// Exchanges of tetrahedra for better ones: face swaps (2-3) and edge removals (3-2, 4-4, n to 2n-4), the best
// triangulation of each link found by dynamic programming.
#pragma once

#include <array>
#include <cstddef>
#include <tuple>
#include <vector>

#include "mesh/edge_removal.h"
#include "mesh/tet_mesh.h"
#include "optimise/badness.h"
#include "optimise/qualities.h"

namespace holdfast {

class Exchanger {
 public:
  Exchanger(TetMesh& mesh, Qualities& qualities, const BadFrom& bad_from)
      : mesh_(mesh), qualities_(qualities), bad_from_(bad_from) {}

  /// Makes the best of the ten exchanges at a tetrahedron, those of its six edges and four faces, if what
  /// comes is better than what goes. Constraints stand. `created` receives the new tetrahedra, whose
  /// qualities the caller has to forget. Returns whether an exchange was made.
  bool improve(Tet t, std::vector<Tet>& created);

 private:
  void try_edge(Tet t, int edge);
  void try_face(Face f);
  [[nodiscard]] bool is_best(const Badness& before, const Badness& after);

  TetMesh& mesh_;
  Qualities& qualities_;
  const BadFrom bad_from_;
  EdgeShell shell_;
  LinkTriangulation<Badness> triangulation_;
  std::vector<TetMesh::Corners> candidate_;
  // The best so far, by what it changes: numbers of null, hopeless and flat ones, then the ratio of the worst
  // Q.
  using Gain = std::tuple<std::ptrdiff_t, std::ptrdiff_t, std::ptrdiff_t, double>;
  Gain gain_;
  enum class Way { none, edge, face } way_ = Way::none;
  EdgeShell best_shell_;
  std::vector<LinkTriangle> best_triangles_;
  std::array<Tet, 2> best_pair_{};
  std::vector<TetMesh::Corners> best_three_;
};

}  // namespace holdfast
