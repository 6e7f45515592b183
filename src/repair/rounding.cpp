// The exact arrangement rounded to doubles so that it stays valid.
#include "repair/rounding.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "repair/bounds.h"
#include "repair/covered.h"
#include "repair/fins.h"
#include "repair/ladder.h"
#include "repair/open_sides.h"
#include "repair/repeated.h"
#include "repair/restore.h"
#include "repair/strips.h"
#include "surface/places.h"

namespace holdfast::repairing {
namespace {

/// Whether the only change was to move the points of an exact arrangement to their nearest doubles, with no
/// two used points at the same double. Then the parts of a facet are connected as in the arrangement, where
/// they cover the facet: their border follows its sides as closely as the points moved.
bool is_rounded_once(const State& state, const RepairReport& report) {
  if (report.rounds > 1 || report.rung > Rung::nearest) return false;
  const std::vector<Index> first = first_at_places(state.vertices);
  return std::all_of(state.facets.begin(), state.facets.end(), [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](Index v) { return first[v] == v; });
  });
}

/// Welding adds vertices. The surface is compared with the given one by the numbers of its vertices, which
/// only those of the input keep, so all of them count as such until the end.
State with_all_of_input(State state) {
  state.input_vertices = state.vertices.size();
  return state;
}

/// The rounding of an exact arrangement, which is close to the given surface in the end.
class ArrangedRounding {
 public:
  ArrangedRounding(State state, const RepairOptions& options, RepairReport& report, ExactSurface& exact,
                   const Step& step, const Threads& threads, Trials trials)
      : options_(options),
        report_(report),
        told_(report),
        exact_(exact),
        step_(step),
        threads_(threads),
        trials_(trials),
        repeated_(merge_repeated(state)),
        of_given_(std::exchange(state.facet_parents, identity(state.facets.size()))),
        input_vertices_(state.input_vertices),
        given_(with_all_of_input(std::move(state))) {}

  Rounded run() {
    Rounded rounded = climb();
    report_.pairs += repeated_;
    rounded.joined_within = joined_within_;
    if (rounded.is_valid) follow_given(rounded);
    rounded.state.facet_parents = composed(of_given_, std::move(rounded.state.facet_parents));
    rounded.state.input_vertices = input_vertices_;
    if (input_vertices_ < given_.vertices.size()) drop_unused(rounded.state);
    return rounded;
  }

 private:
  /// A ladder whose first rungs have been tried. If joining within the user's distance multiplies the facets
  /// in vain, less is tried, and none at last.
  Ladder begun(SidesOf sides) {
    std::optional<Ladder> ladder;
    for (const double part : kPartsOfJoin) {
      ladder.emplace(begun(sides, part * options_.join));
      if (joined_within_ == 0 || !ladder->is_overgrown(given_.facets.size())) break;
    }
    return *std::move(ladder);
  }

  Ladder begun(SidesOf sides, double join) {
    joined_within_ = join;
    Ladder ladder(given_, options_, told_, {exact_, of_given_}, planes_, step_, threads_);
    if (trials_ != Trials::all) ladder.leave_out_joining_all();
    if (trials_ == Trials::little) ladder.try_little();
    ladder.compare_with(given_);
    if (join > 0) ladder.flatten_all(join, sides);
    ladder.begin();
    return ladder;
  }

  /// Sheets with common sides may leave thin facets between them, attached to the surface by one side. If so,
  /// the sheets are tried one after the other.
  Rounded climb() {
    Ladder together = begun(SidesOf::all_sheets);
    std::optional<Ladder> one_by_one;
    if (options_.join == 0 && !together.is_valid()) one_by_one.emplace(together);
    Rounded rounded = together.run(SidesOf::all_sheets);
    report_ = together.report();
    if (!rounded.is_valid || report_.rung < Rung::coarser) return rounded;

    constexpr std::size_t kFewSides = 16;  // with more sides, nearly as many are left
    const std::size_t before = open_sides(given_), open = drop_fins_to(before, rounded);
    if (!together.starts_welded() && together.has_shared() && open > before && open <= before + kFewSides) {
      if (!one_by_one) one_by_one.emplace(begun(SidesOf::one_sheet));
      one_by_one->try_no_more_than(together);
      Rounded other = one_by_one->run(SidesOf::one_sheet);
      if (other.is_valid && drop_fins_to(before, other) < open) {
        rounded = std::move(other);
        report_ = one_by_one->report();
      }
    }
    return rounded;
  }

  /// Removes fins if there are more open sides than before. Returns how many there are now.
  [[nodiscard]] std::size_t drop_fins_to(std::size_t before, Rounded& rounded) const {
    const std::size_t open = open_sides(rounded.state);
    if (open <= before) return open;
    const double moved = drop_fins(rounded.state, given_, rounded.displacement);
    rounded.displacement = sum_above(rounded.displacement, moved);
    return open_sides(rounded.state);
  }

  /// Gives vertices their places back, keeps strips, and bounds the distance from the given surface.
  void follow_given(Rounded& rounded) {
    double& most = rounded.displacement;
    const std::span places = std::span(given_.vertices).first(given_.input_vertices);
    most = sum_above(most, restore(rounded.state, places, step_, threads_));
    if (options_.join > 0 || !is_rounded_once(rounded.state, report_)) {
      most = keep_strips(rounded.state, given_, most, step_, threads_);
      most = cover_distance(rounded.state, given_, most, step_);
    }
  }

  const RepairOptions& options_;
  RepairReport& report_;
  const RepairReport told_;  // before
  ExactSurface& exact_;
  const Step& step_;
  const Threads& threads_;
  const Trials trials_;
  const std::size_t repeated_;  // facets that were copies of others
  // Facets are compared with the facets before welding, which are parts of the input's.
  const Parents of_given_;
  const std::size_t input_vertices_;
  const State given_;
  double joined_within_ = 0;
  RoundedPlanes planes_;
};

}  // namespace

Rounded round_arranged(State state, const RepairOptions& options, RepairReport& report, ExactSurface& exact,
                       const Step& step, const Threads& threads, Trials trials) {
  return ArrangedRounding(std::move(state), options, report, exact, step, threads, trials).run();
}

}  // namespace holdfast::repairing
