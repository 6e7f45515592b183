// The worst element first, by the cheapest way that helps, as long as the budget allows it (paper §6.4).
#pragma once

#include <functional>
#include <vector>

#include "mesh/monitor.h"
#include "optimise/agenda.h"
#include "optimise/budget.h"
#include "optimise/optimise.h"
#include "optimise/qualities.h"
#include "optimise/ways_for_quality.h"

namespace holdfast {

/// Every element that was pushed, or that replaced one, waits in the agenda, has been given up, or is gone.
class ElementSearch {
 public:
  /// Vertices from `first_free` on may be moved and removed. `target` is the worst Q that the facets ask for.
  ElementSearch(TetMesh& mesh, Qualities& qualities, Vertex first_free, double target, std::uint64_t seed,
                const Budget& budget, Monitor& monitor);
  ElementSearch(const ElementSearch&) = delete;
  ElementSearch& operator=(const ElementSearch&) = delete;

  void push(std::span<const Tet> tets);
  /// Runs until the agenda is empty or the budget spent, or while `may_go_on` is true. If points may be added
  /// later, the other ways are tried less hard.
  void work_off(Ways::Points points, const std::function<bool()>& may_go_on = {});
  /// The null elements that were given up, if any, are tried again, with points, and what else waits gets a
  /// little work. Returns the work done; the budget begins anew.
  std::size_t work_off_null(const std::function<bool()>& may_go_on = {});
  [[nodiscard]] bool is_current(const WaitingElement& e);
  void poll() { monitor_.poll(Stage::optimise, budget_.fraction()); }

  /// Elements that are no worse than this are left alone.
  [[nodiscard]] double good() const { return good_; }
  [[nodiscard]] const BadFrom& bad_from() const { return bad_from_; }
  [[nodiscard]] Ways& ways() { return ways_; }
  [[nodiscard]] const Ways& ways() const { return ways_; }
  [[nodiscard]] Agenda& agenda() { return agenda_; }
  [[nodiscard]] Budget& budget() { return budget_; }
  [[nodiscard]] OptimiseStats& stats() { return stats_; }
  /// The vertices that were added; some may be gone.
  [[nodiscard]] std::vector<Vertex>& points() { return points_; }
  [[nodiscard]] const std::vector<Vertex>& points() const { return points_; }

 private:
  void push(Tet t);
  void improve(const WaitingElement& e, Ways::Points points);

  TetMesh& mesh_;
  Qualities& qualities_;
  const double good_;
  const BadFrom bad_from_;
  Monitor& monitor_;
  Ways ways_;
  Agenda agenda_;
  Budget budget_;
  OptimiseStats stats_;
  std::vector<Vertex> points_;
};

}  // namespace holdfast
