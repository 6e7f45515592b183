// Flips that clear a target's way: they remove faces and edges that the target crosses, after deeper flips if
// needed (George, Hecht, Saltel 1991; Si 2015, flipnm).
//
// No flip makes the target cross more of the mesh than before, so no flip is ever undone. A failed attempt
// leaves a different mesh with as few crossings, from which the next attempt starts. This walk among meshes
// recovers more than a search that returns to its start, in an eighth of the time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/clear_edge.h"
#include "mesh/tet_mesh.h"
#include "recover/pierce.h"
#include "recover/shell_signs.h"
#include "recover/target.h"
#include "recover/tried_edges.h"

namespace holdfast {

struct FlipCounts {
  std::size_t face_flips = 0, edge_removals = 0;
  [[nodiscard]] std::size_t all() const { return face_flips + edge_removals; }
};

/// The work of attempts, in sign tests, roughly, and the limit of the present attempt.
class FlipWork {
 public:
  void begin(std::size_t budget) {
    budget_ = budget;
    before_ = all_;
  }
  void add(std::size_t tests) { all_ += tests; }
  [[nodiscard]] std::size_t of_attempt() const { return all_ - before_; }
  [[nodiscard]] std::size_t all() const { return all_; }
  [[nodiscard]] bool exhausted() const { return of_attempt() > budget_; }

 private:
  std::size_t budget_ = 0, all_ = 0, before_ = 0;
};

/// The change of the target's cost by the flips of an attempt. The cost never rises above its start.
class CostChange {
 public:
  /// `most_at_end`: the largest change that the flip may leave that ends the attempt.
  void begin(int most_at_end) {
    all_ = 0;
    most_at_end_ = most_at_end;
  }
  [[nodiscard]] bool allows(int more, bool ends_attempt) const {
    return all_ + more <= (ends_attempt ? most_at_end_ : 0);
  }
  void add(int more) { all_ += more; }
  [[nodiscard]] bool is_fall() const { return all_ < 0; }

 private:
  int all_ = 0, most_at_end_ = -1;
};

class Flipper {
 public:
  Flipper(TetMesh& mesh, Random& random)
      : mesh_(mesh), piercing_(mesh, random), random_(random), signs_(mesh) {}

  /// So many levels that the budget ends an attempt, not the depth. In strips of prisms one flip makes way
  /// for the next over dozens of levels.
  static constexpr int kDeep = 64;

  /// Sets the target of the flips from now on.
  void aim(const Target& target) { target_ = target; }

  /// Removes a face or edge that the target crosses, by flips of at most `depth` levels and with limited work
  /// (in sign tests, roughly). Returns true if the target's cost fell. It never rises.
  bool clear(const Crossing& crossing, int depth, std::size_t budget);

  /// Removes edge ab of tetrahedron t for its own sake, by flips of at most `depth` levels, which add no edge
  /// at a or b and none to a target that was aimed at. Returns whether it is gone.
  bool remove(Tet t, Vertex a, Vertex b, int depth, std::size_t budget);

  /// Work of the last call, in sign tests, roughly.
  [[nodiscard]] std::size_t work() const { return work_.of_attempt(); }
  /// Work of all calls.
  [[nodiscard]] std::size_t all_work() const { return work_.all(); }

  /// Whether the tetrahedron of a crossing is still alive and holds it.
  [[nodiscard]] bool stands(const Crossing& crossing) const;
  [[nodiscard]] const FlipCounts& counts() const { return counts_; }

 private:
  [[nodiscard]] bool holds(Tet t, Vertex a, Vertex b) const;
  // In few bits, since millions are put in order.
  class BlockedSpoke {
   public:
    BlockedSpoke() = default;
    BlockedSpoke(std::size_t corner, bool at_b, bool is_blocked_twice)
        : bits_(static_cast<std::uint8_t>(corner << 2 | (at_b ? 2U : 0U) | (is_blocked_twice ? 1U : 0U))) {}
    [[nodiscard]] ShellSpoke spoke() const { return {std::uint32_t{bits_} >> 2U, (bits_ & 2U) != 0}; }
    [[nodiscard]] bool is_blocked_twice() const { return (bits_ & 1U) != 0; }

   private:
    std::uint8_t bits_ = 0;
  };
  using BlockedSpokes = std::array<BlockedSpoke, 2 * kMostLink>;
  // An edge to remove; `depth` more levels may clear its way. Kept to avoid allocations.
  struct Level {
    EdgeShell shell;
    ShellEars ears;
    BlockedSpokes spokes;
    std::size_t next = 0, count = 0;  // of the spokes
  };
  class ForTarget;
  friend EdgeClearing<Flipper>;

  void begin(int depth, std::size_t budget, int most_change_at_end);
  bool flip_face(const Crossing& face);
  bool remove_edge(Tet t, Vertex a, Vertex b, int depth) {
    return EdgeClearing(mesh_, *this).remove(t, a, b, depth, kNone);
  }
  // What EdgeClearing asks for.
  bool may_try(Tet t, Vertex a, Vertex b, int depth);
  Level& level(int depth) { return levels_[static_cast<std::size_t>(depth)]; }
  bool gather(Tet t, Vertex a, Vertex b, Vertex avoided, Level& level);
  bool remove_now(const Level& level, Vertex avoided);
  void begin_spokes(Level& level);
  std::optional<ShellSpoke> next_blocked(Level& level);
  [[nodiscard]] std::size_t edge_removals() const { return counts_.edge_removals; }
  [[nodiscard]] Tet find_edge(Vertex a, Vertex b) { return piercing_.find_edge(a, b); }

  bool clip_ears(EdgeShell& shell);
  bool clip_ear(EdgeShell& shell, std::size_t i);
  void note_flip(std::size_t old_tets, int change);

  TetMesh& mesh_;
  Piercing piercing_;
  Random& random_;
  Target target_ = Target::none();
  FlipWork work_;
  CostChange change_;
  FlipCounts counts_;
  TriedEdges tried_;  // in this attempt, since the last flip

  std::vector<Level> levels_;  // by depth
  ShellSigns signs_;           // of the shell gathered last
  LinkTriangulation<int> triangulation_;
  std::vector<LinkTriangle> triangles_;
  std::vector<Tet> created_;
};

}  // namespace holdfast
