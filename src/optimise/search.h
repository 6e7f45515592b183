// The search of the optimisation in a whole mesh: work on one element after the other (element_search.h), and
// larger trials that may be undone.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "mesh/monitor.h"
#include "mesh/parallel.h"
#include "mesh/undo_log.h"
#include "optimise/element_search.h"

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
  /// The Q of these, by all threads.
  void compute(std::span<const Tet> tets) { qualities_.compute(tets, threads_); }
  void push_all(std::span<const Tet> tets) {
    compute(tets);
    push(tets);
  }
  void push(std::span<const Tet> tets) { elements_.push(tets); }
  void work_off(Ways::Points points) { elements_.work_off(points); }
  std::size_t work_off_null() { return elements_.work_off_null(); }

  /// Part of the search that may be undone.
  class Trial {
   public:
    /// With the waiting elements, or without: then the search continues from those that the trial changes.
    enum class Agenda { kept, set_aside };
    Trial(Search& search, Agenda agenda);
    ~Trial() { search_.log_.release(); }
    Trial(const Trial&) = delete;
    Trial& operator=(const Trial&) = delete;
    /// The part that has changed since it began is improved like any other part of the mesh, with a separate
    /// budget.
    void improve_what_changed();
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
  [[nodiscard]] const BadFrom& bad_from() const { return elements_.bad_from(); }
  [[nodiscard]] Vertex first_free() const { return elements_.ways().first_free(); }
  [[nodiscard]] ElementSearch& elements() { return elements_; }
  [[nodiscard]] Qualities& qualities() { return qualities_; }
  [[nodiscard]] Agenda& agenda() { return elements_.agenda(); }
  [[nodiscard]] Budget& budget() { return elements_.budget(); }
  [[nodiscard]] OptimiseStats& stats() { return elements_.stats(); }
  [[nodiscard]] std::mt19937_64& random() { return elements_.ways().random(); }
  void poll() { elements_.poll(); }
  /// All points that may move, and some that are gone.
  [[nodiscard]] const std::vector<Vertex>& points() const { return elements_.points(); }
  [[nodiscard]] std::size_t points_in_mesh() const;
  /// Whether a slot was, to begin with, one of those that are to be better, or dead.
  [[nodiscard]] bool is_ours(Tet t) const { return t >= is_others_.size() || !is_others_[t]; }
  [[nodiscard]] bool is_current(const WaitingElement& e) { return elements_.is_current(e); }
  [[nodiscard]] Badness badness();
  /// How bad an element may be for a point to go: as long as a worse one stays, nothing is worth a point but
  /// null elements.
  [[nodiscard]] double worst_without_point() {
    return std::max(bad_from().flat, std::min(badness().worst, bad_from().null));
  }
  /// The worst of the elements that are to be better, except those left out, whether it waits, was given up,
  /// or neither; nothing if none is worse than good.
  [[nodiscard]] std::optional<WaitingElement> worst(std::span<const TetMesh::Corners> left_out = {});
  /// Vertices that are free, and new in the mesh.
  void add_points(std::span<const Vertex> points) {
    elements_.points().insert(elements_.points().end(), points.begin(), points.end());
  }
  [[nodiscard]] const Threads& threads() const { return threads_; }
  void forget(std::span<const Tet> tets) { qualities_.forget(tets); }
  void forget_all() { qualities_.forget_all(); }

 private:
  TetMesh& mesh_;
  const double target_;
  const Threads threads_;
  std::vector<bool> is_others_;  // by slot
  Qualities qualities_;
  ElementSearch elements_;
  UndoLog log_;
};

}  // namespace holdfast
