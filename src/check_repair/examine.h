// Check of repairs: all rules of the promise, from nothing but the public arrays.
#pragma once

#include <functional>

#include "holdfast/check_repair.h"

namespace holdfast::checking {

/// `step` is called now and then with the share of the work that is done, and may throw to stop.
[[nodiscard]] RepairCheckResult examine_repair(const Complex& input, const Complex& output,
                                               const RepairClaims& claims, std::size_t most,
                                               const std::function<void(double)>& step);

}  // namespace holdfast::checking
