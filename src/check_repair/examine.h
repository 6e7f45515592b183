// Check of repairs: all rules of the promise, from nothing but the public arrays.
#pragma once

#include <functional>

#include "holdfast/check_repair.h"

namespace holdfast::checking {

/// `step` is called now and then with the share of the work that is done, and may throw to stop.
[[nodiscard]] RepairCheckResult examine_repair(const Complex& input, const Complex& output,
                                               const RepairClaims& claims, std::size_t most,
                                               const std::function<void(double)>& step);

/// Whether each of the two lies within the largest distance that is claimed of the other, by the rules that
/// say so. `step` as above.
[[nodiscard]] bool is_within_distance(const Complex& input, const Complex& output, const RepairClaims& claims,
                                      const std::function<void(double)>& step);

}  // namespace holdfast::checking
