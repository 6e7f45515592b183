#include "api/course.h"

#include <array>
#include <numeric>

namespace holdfast {
namespace {

using Costs = std::array<double, 10>;  // by step, relative to a whole call without field points

// Medians for mechanical parts, smooth surfaces and layered surfaces; single runs often differ by a factor of
// a few.
Costs costs(const Options& options) {
  Costs cost{0.02, 0.1, 0.01, 0.05, 0.05, 0.01, 0.04, 0, 0.3, 0.03};
  if (options.sizes) {
    cost[static_cast<std::size_t>(CallStep::field_points)] = 0.3;
    cost[static_cast<std::size_t>(CallStep::optimise)] = options.effort == Effort::fast   ? 0.3
                                                         : options.effort == Effort::good ? 1.5
                                                                                          : 10;
  }
  if (!options.optimise) cost[static_cast<std::size_t>(CallStep::optimise)] = 0;
  return cost;
}

// Elimination is part of the partition's loop: the points of one constraint are removed before those of the
// next are added.
CallStep last_step(const Options& options) {
  switch (options.stop_after.value_or(Stage::optimise)) {
    case Stage::validate:
      return CallStep::validate;
    case Stage::delaunay:
      return CallStep::validate_missing;
    case Stage::flips:
      return CallStep::flips;
    case Stage::partition:
    case Stage::eliminate:
      return CallStep::partition;
    case Stage::classify:
      return CallStep::classify;
    case Stage::suppress:
      return CallStep::suppress;
    case Stage::field_points:
      return CallStep::field_points;
    case Stage::optimise:
      break;
  }
  return CallStep::deliver;
}

// The part of the whole call that a step takes if `done` was done when it began: its usual share of the work
// that is left. So another attempt continues from the progress of the previous one, which never decreases.
std::array<double, 2> part_of_call(CallStep step, double done, const Options& options) {
  const Costs cost = costs(options);
  const auto at = cost.begin() + static_cast<std::ptrdiff_t>(step);
  const double left = std::accumulate(at, cost.end(), 0.0);
  return {done, done + (1 - done) * *at / left};
}

}  // namespace

Course::Course(const Options& options, Monitor& monitor, Report& report)
    : options_(options), monitor_(monitor), report_(report), last_(last_step(options)) {}

void Course::begin(CallStep step) const {
  monitor_.begin_part(part_of_call(step, monitor_.overall(), options_));
}

Stage Course::stage_of(CallStep step) {
  static constexpr std::array<Stage, 9> kStages{Stage::validate, Stage::delaunay,     Stage::validate,
                                                Stage::flips,    Stage::partition,    Stage::classify,
                                                Stage::suppress, Stage::field_points, Stage::optimise};
  return kStages.at(static_cast<std::size_t>(step));
}

}  // namespace holdfast
