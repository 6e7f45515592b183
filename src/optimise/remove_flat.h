// Removing flat and other bad tetrahedra by flips that clear each other's way (the recursion of Si 2015's
// flipnm, with quality in place of positivity).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "mesh/edge_removal.h"
#include "mesh/tet_mesh.h"
#include "optimise/tuning.h"

namespace holdfast {

class FlatRemover {
 public:
  explicit FlatRemover(TetMesh& mesh) : mesh_(mesh) {}

  /// Removes one of the wide edges of a tetrahedron whose Q is `bad_from` or more, so that fewer are as bad.
  /// Flips on the way there make none that bad, but may make some worse, and stay even if the edge does.
  /// `created` receives the new tetrahedra, some of which may be gone again. Returns whether there are fewer.
  bool remove(Tet t, double bad_from, std::vector<Tet>& created);

  /// Of the last call, in shells looked at.
  [[nodiscard]] std::size_t work() const { return work_; }

 private:
  bool remove_edge(Tet t, Vertex a, Vertex b, int depth, Vertex avoided);
  bool remove_now(const EdgeShell& shell, Vertex avoided);
  bool thin_out(const EdgeShell& shell, int depth);
  [[nodiscard]] Tet survivor(const EdgeShell& shell);
  [[nodiscard]] bool is_good(Vertex a, Vertex b, Vertex c, Vertex d) const;

  TetMesh& mesh_;
  double bad_from_ = 0;
  std::array<EdgeShell, tuning::kFlatDepth + 1>
      shells_;  // by depth; kept, like what follows, to allocate nothing
  std::vector<LinkTriangle> triangles_;
  LinkTriangulation<double> triangulation_;
  std::size_t work_ = 0;
  std::vector<Tet>* created_ = nullptr;
};

}  // namespace holdfast
