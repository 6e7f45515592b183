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

/// Receives the exact arrangement; `of_given` holds the parents of the facets that are arranged.
struct Exact {
  ExactSurface& surface;
  const Parents& of_given;
};

/// One way to make a surface valid. A ladder cuts the surface and rounds it. While facets are still in
/// trouble, it joins what lies near them, at growing distances. The state in which one ladder fails may be
/// the start of another.
class Ladder {
 public:
  Ladder(State state, const RepairOptions& options, const RepairReport& report, const Exact& exact,
         RoundedPlanes& planes, const Step& step, const Threads& threads);

  [[nodiscard]] const RepairReport& report() const { return report_; }
  [[nodiscard]] bool is_valid() const { return rounded_.is_valid; }
  /// Whether this ladder started from a surface whose vertices were welded.
  [[nodiscard]] bool starts_welded() const { return welded_last_bits_ > 0; }
  /// Whether several flattened sheets had a led side. If not, every SidesOf gives the same result.
  [[nodiscard]] bool has_shared() const { return has_shared_; }

  /// Compares results with the surface before the repair, which must outlive this ladder.
  void compare_with(const State& before) { before_ = &before; }
  void leave_out_joining_all() { joins_all_ = false; }
  /// Whether joining sheets made many times as many facets of `facets`, and much is in trouble after the cut.
  [[nodiscard]] bool is_overgrown(std::size_t facets) const;

  /// Joins within last bits alone, and only if few elements are in trouble.
  void try_little();
  /// Tries no step beyond those that `other` needed.
  void try_no_more_than(const Ladder& other);

  /// Runs the ladder on a plane surface, which has no nearly coincident sheets. A result that moves anything
  /// further than `most` is useless.
  [[nodiscard]] Rounded run_in_plane(double most);

  /// Cuts and rounds, and does so once more if little is in trouble after that. Otherwise a second cut would
  /// leave much, or even add to it, and is left to `cut_late`.
  void begin();

  /// Continues after `begin` until the surface is valid or no step is left.
  Rounded run(SidesOf sides = SidesOf::all_sheets);

  /// Makes sheets that coincide within `gap` one, whether they are in trouble or not.
  void flatten_all(double gap, SidesOf sides);

 private:
  /// Tries the plans, which change the surface only near facets in trouble.
  void try_plans(SidesOf sides);

  /// Treats a surface most of whose vertices in trouble are duplicated. If twins are only last bits apart,
  /// the plans that follow start by making them one. If they are further apart, a weld alone may do. Returns
  /// true if it made the surface valid.
  bool begin_with_twins();

  /// Tries the plans from the first untried one on.
  void try_next_plans();

  /// The second cut. In a plane it stops if it needs more new points than the first one, which would lead
  /// nowhere.
  void cut_again();

  /// The second cut, if `begin` left it out and far less is not in trouble by now. Its result is kept if it
  /// leaves less in trouble than all tried since.
  void cut_late();

  /// Whether nothing is in trouble. Builds with HOLDFAST_VALIDATE search again without relying on facets
  /// known to fit together, and throw std::logic_error if some of them do not.
  [[nodiscard]] bool is_done() const;

  /// Whether no result can be of use any more: displacements never shrink, and all states are beyond the
  /// limit.
  [[nodiscard]] bool is_hopeless() const;

  [[nodiscard]] Step here() const;

  /// The surface after the first cut, while the second one is put off.
  struct OnceCut {
    Rounded rounded;
    std::size_t in_trouble;  // at least so many elements
  };

  /// A state of the surface that may become the current one.
  struct Attempt {
    State state;
    Trouble trouble;
    double displacement;
  };

  /// Joins in several passes, because bending makes new sides. The pass that leaves the least in trouble
  /// counts. If joining alone does not help, vertices are put where sides pass each other. This may take some
  /// passes: nearly coincident sheets agree only when the diagonals of their common area agree, too.
  void join(const Plan& plan);

  /// Joins from the current state. If that leaves more in trouble than the best state so far, joins again
  /// from the best state.
  void join_from_best(const Plan& plan);

  /// Whether a share of the input vertices in trouble is so near to others that kWeldedPlans weld them: they
  /// may be the two sides of a crack.
  [[nodiscard]] bool has_twins() const;

  /// Joins triangles in trouble before input vertices are welded. If much stays in trouble, the joining is
  /// undone.
  void join_first();

  [[nodiscard]] RoundPlane round_plane();

  void flatten_all(State& state, double gap, double& displacement);
  void flatten_all(State& state, const Clusters& clusters, double gap, double& displacement);

  /// Makes sheets one that are in trouble and coincide by now.
  void flatten_again(const Plan& plan);

  void begin_flat(std::span<const Plan> plans);
  /// The same after other plans.
  void begin_flat_late(std::span<const Plan> plans);

  /// Starts again from the given surface and makes coincident sheets one before the first cut, because their
  /// planes would cross in lines all over the sheets. The result is kept if it leaves less in trouble.
  void begin_flat(const Plan& plan);

  /// Whether a share of the facets in trouble are parts of these facets of the given surface. If not, it will
  /// hardly help to change these.
  [[nodiscard]] bool concerns_trouble(std::span<const Index> facets) const;

  /// Cuts and rounds twice. Returns false if a cut takes more new points than it did before sheets were made
  /// one, or the second cut more than the first, because then more would be in trouble, too. A few points
  /// more are allowed. Returns true without a cut if the first one would take several times as many points:
  /// cutting is then useless, and the uncut sheets are a start.
  bool cut_flat();

  /// First last resort: makes coincident sheets one all over the surface, whether the cuts beside them are in
  /// trouble or not, and tries all the steps above from there.
  bool join_all();

  /// Second last resort, if little is in trouble: rounds the vertices in trouble to the points of ever
  /// coarser grids and cuts again what then crosses. A result counts only if it covers the surface before the
  /// repair.
  bool snap_all(Ladder from);

  /// Tries one grid, from the best state so far.
  void snap(double cell, Attempt& best);

  /// Whether the surface is valid, and known to cover the surface before the repair.
  [[nodiscard]] bool is_covered() const;

  /// Third last resort: before the first cut, joins nearby vertices and leads sides through nearby vertices
  /// all over the surface. If this brings sheets together, they are made one as well.
  void weld_all();

  /// A ladder that starts from a welded surface.
  [[nodiscard]] Ladder welded(State state, double displacement, double last_bits) const;

  bool take_if_valid(const Ladder& other);

  [[nodiscard]] static bool are_same(const State& a, const State& b);

  void stand(Attempt attempt);
  /// Whether the present state is that one.
  [[nodiscard]] bool stands_like(const Attempt& attempt) const;

  /// Cuts and rounds the current state. Returns the number of new points, or nothing if there would be more
  /// than `most_points`; the state is then unchanged. `before`, if given, is the same state, and learns which
  /// of its facets fit together.
  std::optional<std::size_t> cut(std::size_t most_points, State* before = nullptr, std::size_t counts_to = 0);
  /// For an arrangement with at most this many new points.
  [[nodiscard]] arrange::ArrangeOptions at_most(std::size_t points) const;

  /// Cuts if that takes few new points. When little is in trouble, many new points are a sign of nearly
  /// coincident facets; the next plan then joins more instead.
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
  bool tries_little_ = false;
  double welded_last_bits_ = 0;
  bool is_welded_ = false;  // kWeldedPlans were tried
  // They left little in trouble, which the first plan may join in a hundredth of the time that kFlatPlans
  // take.
  bool puts_off_flat_ = false;
  // Of kPlans: the next one, and how many to try.
  std::size_t next_plan_ = 0, plans_ = kPlans.size();
  bool has_shared_ = false;
  Work work_;  // of joining
  double most_displacement_ = std::numeric_limits<double>::infinity();
  std::size_t most_facets_ = SIZE_MAX;                  // upper limit of facets after joining
  bool grows_ = false;                                  // joining or cutting exceeded its limit
  std::array<std::size_t, 2> new_points_{0, SIZE_MAX};  // of the first and the second cut, if they were made
  std::size_t too_many_ = 0;                            // new points that a refused cut would have taken
  State given_;
  double given_displacement_ = 0;  // by earlier steps: welding, or sheets made one
  Rounded rounded_;
  Trouble trouble_;
  std::optional<OnceCut> once_cut_;
  std::optional<Attempt> best_;    // of the plans so far
  std::size_t in_vain_ = 0;        // the last calls of flatten_again
  State flattened_;                // by the last call of begin_flat
  const State* before_ = nullptr;  // see compare_with
  ProvenSets proven_;              // for attempts that start again from the given surface
};

}  // namespace holdfast::repairing
