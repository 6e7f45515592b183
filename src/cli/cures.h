// The proposals of `diagnose`, as options of `holdfast repair`.
#pragma once

#include <string>

#include "holdfast/cures.h"
#include "report.h"

namespace holdfast::cli {

/// A line for each proposal, then the command; empty where there is nothing to cure.
[[nodiscard]] std::string cures_text(const Cures& cures);

/// "tried", "options" as they are typed, and the proposals.
[[nodiscard]] Json to_json(const Cures& cures);

}  // namespace holdfast::cli
