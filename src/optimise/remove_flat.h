// Removing flat tetrahedra by flips that clear each other's way (the recursion of Si 2015's flipnm, with
// quality in place of positivity).
#pragma once

#include <cstddef>
#include <vector>

#include "mesh/edge_removal.h"
#include "mesh/tet_mesh.h"

namespace holdfast {

class FlatRemover {
 public:
  FlatRemover(TetMesh& mesh, double flat_from) : mesh_(mesh), flat_from_(flat_from) {}

  /// Removes one of the wide edges of a flat tetrahedron, so that fewer tetrahedra are flat. Flips on the way
  /// there make none flat, but may make some worse, and stay even if the edge does. `created` receives the
  /// new tetrahedra, some of which may be gone again. Returns whether there are fewer flat ones.
  bool remove(Tet t, std::vector<Tet>& created);

  /// Of the last call, in shells looked at.
  [[nodiscard]] std::size_t work() const { return work_; }

 private:
  bool remove_edge(Tet t, Vertex a, Vertex b, int depth, Vertex avoided);
  bool remove_now(const EdgeShell& shell, Vertex avoided);
  bool thin_out(const EdgeShell& shell, int depth);
  [[nodiscard]] Tet survivor(const EdgeShell& shell);
  [[nodiscard]] bool is_good(Vertex a, Vertex b, Vertex c, Vertex d) const;

  static constexpr int kDepth = 4;
  static constexpr std::size_t kMostShell = 14;
  static constexpr std::size_t kBudget = 200;  // shells looked at

  TetMesh& mesh_;
  const double flat_from_;
  LinkTriangulation<double> triangulation_;
  std::size_t work_ = 0;
  std::vector<Tet>* created_ = nullptr;
};

}  // namespace holdfast
