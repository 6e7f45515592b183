// The proposals of `diagnose`, expressed as options of `holdfast repair`.
#pragma once

#include <string>

#include "holdfast/cures.h"
#include "report.h"

namespace holdfast::cli {

/// One line per proposal, then the command; empty if there is nothing to cure.
[[nodiscard]] std::string cures_text(const Cures& cures);

/// "tried", "options" as the user would type them, and the proposals.
[[nodiscard]] Json to_json(const Cures& cures);

}  // namespace holdfast::cli
