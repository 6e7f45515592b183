// Hints for a repair that fails or does not do what was asked for.
#pragma once

#include <string>

#include "holdfast/repair.h"

namespace holdfast::cli {

/// A sentence on what to try if no rounding was found: it names an option and, if possible, a length to begin
/// with.
[[nodiscard]] std::string what_may_help(const Surface& given, const RepairOptions& options);

/// Says that a length for `--weld` is less than the least distance of two places; empty if it is not.
[[nodiscard]] std::string told_below_last_bit(const Surface& given, double weld);

}  // namespace holdfast::cli
