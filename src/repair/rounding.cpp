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
#include "repair/restore.h"
#include "repair/strips.h"
#include "surface/places.h"

namespace holdfast::repairing {
namespace {

/// Whether the only change was to move the points of an exact arrangement to their nearest doubles, with no
/// two used points at the same double. Then the parts of a facet are connected as in the arrangement, where
/// they cover the facet: their border follows its sides as closely as the points moved.
bool is_rounded_once(const State& state, const RepairReport& report) {
  if (report.rounds != 1 || report.rung > Rung::nearest) return false;
  const std::vector<Index> first = first_at_places(state.vertices);
  return std::all_of(state.facets.begin(), state.facets.end(), [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](Index v) { return first[v] == v; });
  });
}

}  // namespace

/// Sheets with common sides may leave thin facets between them, attached to the surface by one side. If so,
/// these are tried one after the other.
Rounded round_arranged(State state, const RepairOptions& options, RepairReport& report, ExactSurface& exact,
                       const Step& step, const Threads& threads, Trials trials) {
  // Facets are compared with the facets before welding, which are parts of the input's.
  const Parents of_given = std::exchange(state.facet_parents, identity(state.facets.size()));
  const State given = state;
  RoundedPlanes planes;
  const auto begun = [&](const RepairReport& told, SidesOf sides) {
    Ladder rounding(given, options, told, {exact, of_given}, planes, step, threads);
    if (trials == Trials::near_trouble) rounding.leave_out_joining_all();
    rounding.compare_with(given);
    if (options.join > 0) rounding.flatten_all(options.join, sides);
    rounding.begin();
    return rounding;
  };
  const RepairReport told = report;
  Ladder together = begun(told, SidesOf::all_sheets);
  std::optional<Ladder> one_by_one;
  if (options.join == 0 && !together.is_valid()) one_by_one.emplace(together);
  Rounded rounded = together.run(SidesOf::all_sheets);
  report = together.report();
  if (rounded.is_valid && report.rung >= Rung::coarser) {
    constexpr std::size_t kFewSides = 16;  // with more sides, nearly as many are left
    const std::size_t open = open_sides(rounded.state), before = open_sides(given);
    if (!together.starts_welded() && together.has_led() && open > before && open <= before + kFewSides) {
      if (!one_by_one) one_by_one.emplace(begun(told, SidesOf::one_sheet));
      one_by_one->try_no_more_than(together);
      Rounded other = one_by_one->run(SidesOf::one_sheet);
      if (other.is_valid && open_sides(other.state) < open) {
        rounded = std::move(other);
        report = one_by_one->report();
      }
    }
    if (open > before)
      rounded.displacement =
          sum_above(rounded.displacement, drop_fins(rounded.state, given, rounded.displacement));
  }
  if (rounded.is_valid) {
    double& most = rounded.displacement;
    const std::span places = std::span(given.vertices).first(given.input_vertices);
    most = sum_above(most, restore(rounded.state, places, step, threads));
    if (options.join > 0 || !is_rounded_once(rounded.state, report)) {
      most = keep_strips(rounded.state, given, most, step, threads);
      most = covered_within(rounded.state, given, most, step).value_or(most);
    }
  }
  rounded.state.facet_parents = composed(of_given, rounded.state.facet_parents);
  return rounded;
}

}  // namespace holdfast::repairing
