// Check: all rules of the promise on one mesh, from nothing but the public arrays.
#pragma once

#include <functional>

#include "holdfast/check.h"

namespace holdfast::checking {

/// `step` is called now and then with the share of the work that is done, and may throw to stop.
[[nodiscard]] CheckResult examine(const Complex& surface, const Volume& volume, const CheckOptions& options,
                                  const std::function<void(double)>& step);

}  // namespace holdfast::checking
