// Removing flat and other bad tetrahedra by flips that clear each other's way (the recursion of Si 2015's
// flipnm, with quality instead of positivity).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "mesh/clear_edge.h"
#include "mesh/tet_mesh.h"
#include "optimise/tuning.h"

namespace holdfast {

class FlatRemover {
 public:
  explicit FlatRemover(TetMesh& mesh) : mesh_(mesh) {}

  /// Removes one of the wide edges of a tetrahedron whose Q is `bad_from` or more, so that fewer tetrahedra
  /// are as bad. Flips on the way make no tetrahedron that bad, but may make some worse. They stay even if
  /// the edge stays. `created` receives the new tetrahedra, some of which may be gone again. Returns whether
  /// there are fewer.
  bool remove(Tet t, double bad_from, std::vector<Tet>& created);

  /// Of the last call, in shells looked at.
  [[nodiscard]] std::size_t work() const { return work_; }

 private:
  // An edge that is to go; kept, like what follows, to allocate nothing.
  struct Level {
    EdgeShell shell;
    std::uint32_t next = 0;  // of its spokes, two a corner of the link
  };
  friend EdgeClearing<FlatRemover>;

  // What EdgeClearing asks for.
  static bool may_try(Tet, Vertex, Vertex, int) { return true; }
  Level& level(int depth) { return levels_[static_cast<std::size_t>(depth)]; }
  bool gather(Tet t, Vertex a, Vertex b, Vertex avoided, Level& level);
  bool remove_now(const Level& level, Vertex avoided);
  static void begin_spokes(Level& level) { level.next = 0; }
  std::optional<ShellSpoke> next_blocked(Level& level) const;
  [[nodiscard]] std::size_t edge_removals() const { return edge_removals_; }
  [[nodiscard]] Tet find_edge(Vertex a, Vertex b);

  [[nodiscard]] bool is_good(Vertex a, Vertex b, Vertex c, Vertex d) const;

  TetMesh& mesh_;
  double bad_from_ = 0;
  std::array<Level, tuning::kFlatDepth + 1> levels_;  // by depth
  std::vector<LinkTriangle> triangles_;
  std::vector<Tet> round_;
  LinkTriangulation<double> triangulation_;
  std::size_t work_ = 0, edge_removals_ = 0;
  std::vector<Tet>* created_ = nullptr;
};

}  // namespace holdfast
