// Check: all rules of the promise on one mesh, from nothing but the public arrays.
#pragma once

#include <functional>

#include "holdfast/check.h"

namespace holdfast::checking {

/// Calls `step` now and then with the finished share of the work; `step` may throw to stop.
[[nodiscard]] CheckResult examine(const Complex& surface, const Volume& volume, const CheckOptions& options,
                                  const std::function<void(double)>& step);

}  // namespace holdfast::checking
