// The rungs of a repair, one after the other until the exact search finds nothing in trouble
// (docs/repairing.md).
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "holdfast/repair.h"
#include "repair/flatten.h"
#include "repair/plans.h"
#include "repair/proven.h"
#include "repair/rounded_planes.h"
#include "repair/rounding.h"
#include "repair/settle.h"
#include "repair/state.h"

namespace holdfast::repairing {

/// Where the exact arrangement is told, and the parents of the facets that are arranged.
struct Exact {
  ExactSurface& surface;
  const Parents& of_given;
};

/// One way from an arrangement to a surface that is valid: it is cut and rounded, and where that leaves
/// something in trouble, what is near is joined, by more and more. What fails may be a start for another one.
class Ladder {
 public:
  Ladder(State state, const RepairOptions& options, const RepairReport& report, const Exact& exact,
         RoundedPlanes& planes, const Step& step, const Threads& threads);

  [[nodiscard]] const RepairReport& report() const { return report_; }
  [[nodiscard]] bool is_valid() const { return rounded_.is_valid; }
  /// Whether vertices all over the surface became others first.
  [[nodiscard]] bool starts_welded() const { return welded_last_bits_ > 0; }
  /// Whether sheets that were made one have led a side: else it is the same for any SidesOf.
  [[nodiscard]] bool has_led() const { return has_led_; }

  /// The surface as it was before anything was done, which must outlive this.
  void compare_with(const State& before) { before_ = &before; }
  void leave_out_joining_all() { joins_all_ = false; }
  /// Tries nothing that another one did not need.
  void try_no_more_than(const Ladder& other);

  /// A plane surface has no sheets that lie in each other but for rounding. What moves further than `most` is
  /// of no use.
  [[nodiscard]] Rounded run_in_plane(double most);

  /// Cuts and rounds, twice unless so much is in trouble then that a second time would make more of it: this
  /// comes late, if at all.
  void begin();

  /// Goes on from there.
  Rounded run(SidesOf sides = SidesOf::all_sheets);

  /// Makes sheets one that lie in each other within the gap, whether they are in trouble or not.
  void flatten_all(double gap, SidesOf sides);

 private:
  /// What is tried near what is in trouble.
  void try_plans(SidesOf sides);

  /// Where most of what is in trouble is there twice: but for last bits, so that these are made one at first
  /// in what comes; or by more, and then a weld may be all that it takes. True where that ends it.
  bool begin_with_twins();

  /// From the first that has not been tried yet.
  void try_next_plans();

  /// In a plane, more new points than the first time lead nowhere.
  void cut_again();

  /// The second time, where it was left out. Counts if it leaves less in trouble than what was tried since.
  void cut_late();

  /// Nothing is in trouble. In builds with HOLDFAST_VALIDATE nothing that is said to be known is taken for
  /// granted: throws std::logic_error where it is not so.
  [[nodiscard]] bool is_done() const;

  /// All that may come to stand is of no use, since nothing moves back.
  [[nodiscard]] bool is_hopeless() const;

  [[nodiscard]] Step here() const;

  /// A state that stands, or may come to stand.
  struct Attempt {
    State state;
    Trouble trouble;
    double displacement;
  };

  /// Joins again and again, since bending makes new sides; the pass that leaves the least in trouble counts.
  /// Where joining does not help by itself, vertices are put where sides pass each other. That may take some
  /// passes: sheets that lie in each other agree only when the diagonals of what they share do, too.
  void join(const Plan& plan);

  /// From what the last plan left and cutting made of it, and if that leaves more in trouble than the best so
  /// far, from this.
  void join_from_best(const Plan& plan);

  /// Where sheets were made one, what is in trouble beside them may be joined at once. Goes back where it
  /// cannot.
  void join_flat();

  [[nodiscard]] RoundPlane round_plane();

  void flatten_all(State& state, double gap, double& displacement);

  /// Makes sheets one that lie in each other by now and are in trouble.
  void flatten_again(const Plan& plan);

  void begin_flat(std::span<const Plan> plans);

  /// Begins again with sheets that lie in each other made one before anything is cut: their planes would
  /// cross in lines all over them. Counts if it leaves less in trouble.
  void begin_flat(const Plan& plan);

  /// Cuts and rounds twice; false where that takes more new points than it did before sheets were made one,
  /// or the second time more than the first: then more would be in trouble, too. A few more are no such sign.
  /// Where it takes several times as many, cutting is no way at all, and the sheets are a start without it.
  bool cut_flat();

  /// Where all of this fails: sheets that lie in each other are made one all over the surface, whether the
  /// cuts beside them are in trouble or not, and are the start of all that was tried before.
  bool join_all();

  /// Where that fails, too, and little is in trouble: its vertices go to the points of a grid, by and by of a
  /// coarser one, and what crosses then is cut again. Only what covers the surface as it was counts.
  bool snap_all(Ladder from);

  /// For one grid, from the best so far.
  void snap(double cell, Attempt& best);

  /// Whether it is valid, and known to cover the surface as it was.
  [[nodiscard]] bool is_covered() const;

  /// Where that fails, too: vertices that are near to each other become one, and sides are led through what
  /// is near, all over the surface, before anything is cut. Where that brings sheets together, they are made
  /// one as well.
  void weld_all();

  /// A way that starts with vertices that were welded.
  [[nodiscard]] Ladder welded(State state, double displacement, double last_bits) const;

  bool take_if_valid(const Ladder& other);

  [[nodiscard]] static bool are_same(const State& a, const State& b);

  void stand(Attempt attempt);

  /// How many new points that took; none where it takes more than so many, and is left undone. `before` is
  /// the same state, if given, and gets to know which facets fit together.
  std::optional<std::size_t> cut(std::size_t most_points, State* before = nullptr);

  /// Where little is in trouble, many new points are a sign of facets that lie in each other: rather than cut
  /// all that, the next plan joins more.
  void cut_if_better();

  const RepairOptions& options_;
  RepairReport report_;
  Exact exact_;
  RoundedPlanes& planes_;
  const Step& step_;
  const Threads& threads_;
  SidesOf sides_ = SidesOf::all_sheets;
  bool is_plane_ = false;
  bool joins_all_ = true;
  double welded_last_bits_ = 0;
  bool is_welded_ = false;                             // what kWeldedPlans say was tried
  std::size_t next_plan_ = 0, plans_ = kPlans.size();  // of kPlans: the next, and how many are tried
  bool has_led_ = false;
  Work work_;  // of joining
  double most_displacement_ = std::numeric_limits<double>::infinity();
  std::size_t most_facets_ = SIZE_MAX;  // that joining may make
  bool grows_ = false;                  // it has made more
  std::array<std::size_t, 2> new_points_{0,
                                         SIZE_MAX};  // of the two cuts that come first, where they were made
  std::size_t too_many_ = 0;                         // that a cut would have taken
  State given_;
  double given_displacement_ = 0;  // by sheets that were made one before
  Rounded rounded_;
  Trouble trouble_;
  std::optional<Rounded> once_cut_;       // and not twice yet
  std::optional<Attempt> best_;           // of the plans so far
  State flattened_;                       // by the last plan that began again
  const State* before_ = nullptr;         // see compare_with
  std::shared_ptr<const Proven> proven_;  // when attempts begin again
};

}  // namespace holdfast::repairing
