// Prints defects: a summary by cause, then the list.
#pragma once

#include <string>

#include "holdfast/holdfast.h"
#include "holdfast/summary.h"
#include "report.h"

namespace holdfast::cli {

/// What a list shows of one cause where someone looks on; and where the defects are not what was asked for.
inline constexpr std::size_t shown_on_terminal = 100;
inline constexpr std::size_t shown_in_passing = 20;

/// The defect's message, with the options that stand for what it says is to be done.
[[nodiscard]] std::string message_of(const Defect& defect);

/// Whether the surface itself breaks no rule, and only the choice of regions to keep does not suit it.
[[nodiscard]] bool is_valid(const std::vector<Defect>& defects);

/// One line a cause: how many, the worst, what to do.
[[nodiscard]] std::string summary_text(const DefectSummary& summary);

/// Cause by cause, at most `most` of each: vertices that are almost one, then the defects. `rest` ends the
/// line that tells how many are left out ("--all lists them").
[[nodiscard]] std::string list_text(const DefectSummary& summary, const std::vector<Defect>& defects,
                                    std::size_t most, const char* rest);

}  // namespace holdfast::cli
