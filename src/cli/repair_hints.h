// What may help where a repair does not do what was asked for.
#pragma once

#include <string>

#include "holdfast/repair.h"

namespace holdfast::cli {

/// What to try where no rounding was found: a sentence that names an option, and a length where there is one
/// to begin with.
[[nodiscard]] std::string what_may_help(const Surface& given, const RepairOptions& options);

/// That a length for `--weld` is less than what two places can be apart; empty where it is not.
[[nodiscard]] std::string told_below_last_bit(const Surface& given, double weld);

}  // namespace holdfast::cli
