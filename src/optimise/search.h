// The search of the optimisation: the worst element first, by the cheapest way that helps (paper §8).
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "mesh/monitor.h"
#include "mesh/parallel.h"
#include "mesh/undo_log.h"
#include "optimise/agenda.h"
#include "optimise/budget.h"
#include "optimise/optimise.h"
#include "optimise/qualities.h"
#include "optimise/ways_for_quality.h"

namespace holdfast {

/// Every element of the regions whose Q is to be better waits in the agenda, has been given up, or is gone.
class Search {
 public:
  /// The tetrahedra are to be better; others of their regions may go for them. Vertices from `first_free` on
  /// may move and go.
  Search(TetMesh& mesh, const std::vector<Tet>& tets, Vertex first_free, double target, std::uint64_t seed,
         const Threads& threads, Monitor& monitor);

  /// Moves the points that were there, to begin with.
  void move_points();
  /// The same as `push`, for a whole mesh: their Q are computed by all threads.
  void push_all(std::span<const Tet> tets);
  void push(std::span<const Tet> tets);
  /// Until the agenda is empty or the budget spent. While points come later, other ways are tried less hard.
  void work_off(Ways::Points points);

  /// Part of the search that may be taken back.
  class Trial {
   public:
    /// With what waits, or without: then the search goes on from what the trial changes.
    enum class Agenda { kept, set_aside };
    Trial(Search& search, Agenda agenda);
    ~Trial() { search_.log_.release(); }
    Trial(const Trial&) = delete;
    Trial& operator=(const Trial&) = delete;
    void take_back();
    /// No more hopeless elements than before, and the worst of all better; other flat ones are of less
    /// account.
    [[nodiscard]] bool has_paid() const;
    [[nodiscard]] UndoLog::Before before() const { return search_.log_.before(mark_); }
    [[nodiscard]] std::size_t points() const { return points_in_mesh_; }

   private:
    Search& search_;
    const UndoLog::Mark mark_;
    holdfast::Agenda agenda_;
    const Budget budget_;
    const OptimiseStats stats_;
    const std::size_t points_, points_in_mesh_;
  };

  [[nodiscard]] TetMesh& mesh() { return mesh_; }
  /// The worst Q that the facets ask for.
  [[nodiscard]] double target() const { return target_; }
  [[nodiscard]] const BadFrom& bad_from() const { return bad_from_; }
  [[nodiscard]] Vertex first_free() const { return ways_.first_free(); }
  [[nodiscard]] Agenda& agenda() { return agenda_; }
  [[nodiscard]] Budget& budget() { return budget_; }
  [[nodiscard]] OptimiseStats& stats() { return stats_; }
  [[nodiscard]] std::mt19937_64& random() { return ways_.random(); }
  void poll() { monitor_.poll(Stage::optimise, budget_.fraction()); }
  /// All points that may move, and some that are gone.
  [[nodiscard]] const std::vector<Vertex>& points() const { return points_; }
  [[nodiscard]] std::size_t points_in_mesh() const;
  /// Whether a slot was, to begin with, one of those that are to be better, or dead.
  [[nodiscard]] bool is_ours(Tet t) const { return t >= is_others_.size() || !is_others_[t]; }
  [[nodiscard]] bool is_current(const WaitingElement& e);
  [[nodiscard]] Badness badness() const;
  /// How bad an element may be for a point to go: as long as a worse one stays, nothing is worth a point but
  /// null elements.
  [[nodiscard]] double worst_without_point() const {
    return std::max(bad_from_.flat, std::min(badness().worst, bad_from_.null));
  }
  /// The worst of the elements that are to be better, whether it waits, was given up, or neither; nothing
  /// where none is worse than good.
  /// None of these elements that are left out.
  [[nodiscard]] std::optional<WaitingElement> worst(std::span<const TetMesh::Corners> left_out = {});
  /// Vertices that are free, and new in the mesh.
  void add_points(std::span<const Vertex> points) {
    points_.insert(points_.end(), points.begin(), points.end());
  }
  void forget(std::span<const Tet> tets) { qualities_.forget(tets); }

 private:
  void push(Tet t);
  void improve(const WaitingElement& e, Ways::Points points);

  TetMesh& mesh_;
  const double target_, good_;
  const BadFrom bad_from_;
  Monitor& monitor_;
  const Threads threads_;
  std::vector<bool> is_others_;  // by slot
  Qualities qualities_;
  Ways ways_;
  UndoLog log_;
  Agenda agenda_;
  Budget budget_;
  std::vector<Vertex> points_;
  OptimiseStats stats_;
};

}  // namespace holdfast
