#include "api/course.h"

#include <numeric>

namespace holdfast {
namespace {

using Costs = std::array<double, 10>;  // by step

// Medians of some mechanical parts, smooth surfaces and layered ones; a few times more or less is common.
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

}  // namespace

std::array<double, 2> part_of_call(CallStep step, double done, const Options& options) {
  const Costs cost = costs(options);
  const auto at = cost.begin() + static_cast<std::ptrdiff_t>(step);
  const double left = std::accumulate(at, cost.end(), 0.0);
  return {done, done + (1 - done) * *at / left};
}

}  // namespace holdfast
