// Flips with a memory: removes faces and edges that stand in a target's way, deeper flips first where
// needed, and takes back what did not help (George, Hecht, Saltel 1991; Si 2015, flipnm).
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/edge_removal.h"
#include "mesh/tet_mesh.h"
#include "recover/pierce.h"
#include "recover/target.h"

namespace holdfast {

struct FlipCounts {
  std::size_t face_flips = 0, edge_removals = 0, undone = 0;
};

class Flipper {
 public:
  Flipper(TetMesh& mesh, Random& random) : mesh_(mesh), piercing_(mesh, random), random_(random) {}

  /// Flips from now on work for this target, with a limit on the work (in sign tests, roughly).
  void aim(const Target& target, std::size_t budget);
  [[nodiscard]] bool exhausted() const { return work_ > budget_; }
  [[nodiscard]] std::size_t work() const { return work_; }

  /// Removes a face or edge that the target crosses, by flips of at most `depth` levels. Returns true if
  /// the target's cost fell; otherwise the mesh is as before.
  bool clear(const Crossing& crossing, int depth, int most_change);
  [[nodiscard]] int last_change() const;

  [[nodiscard]] const FlipCounts& counts() const { return counts_; }

 private:
  // Where a sequence of flips began: what it takes to return there.
  struct Mark {
    std::size_t entries;
    int change;
  };
  struct Entry {
    std::size_t removed, created;  // where they begin
  };
  struct Spoke {
    std::uint32_t corner;
    bool at_b, blocked_twice;
  };
  static constexpr int kNestedChange = 0;
  class ForTarget;

  [[nodiscard]] bool holds(Tet t, Vertex a, Vertex b) const;
  bool flip_face(const Crossing& face);
  bool remove_edge(Tet t, Vertex a, Vertex b, int depth, Vertex favoured);
  bool remove_edge_now(const EdgeShell& shell, Vertex favoured);
  bool thin_out(EdgeShell& shell, int depth);
  [[nodiscard]] Tet survivor(const EdgeShell& shell);

  [[nodiscard]] Mark mark() const { return {entries_.size(), change_}; }
  void apply(const std::vector<Tet>& old_tets, const std::vector<TetMesh::Corners>& new_tets);
  void undo_to(const Mark& mark);
  void forget();

  TetMesh& mesh_;
  Piercing piercing_;
  Random& random_;
  Target target_ = Target::segment(kNone, kNone);
  std::size_t budget_ = 0, work_ = 0;
  int most_change_ = 0;
  int change_ = 0;  // of the target's cost since the journal began
  FlipCounts counts_;

  std::vector<Entry> entries_;
  std::vector<Tet> removed_, created_;
  std::vector<TetMesh::Corners> removed_corners_;

  std::vector<TetMesh::Corners> fresh_;
  std::vector<LinkTriangle> triangles_;
  std::vector<Tet> made_;
};

}  // namespace holdfast
