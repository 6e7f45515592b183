// Prints defects: a summary by cause, then the list.
#pragma once

#include <string>

#include "holdfast/holdfast.h"
#include "holdfast/summary.h"
#include "report.h"

namespace holdfast::cli {

/// The number of defects per cause in a list on a terminal, in a redirected one, and in lists that the user
/// did not ask for.
inline constexpr std::size_t shown_on_terminal = 100;
inline constexpr std::size_t shown_elsewhere = 1000;
inline constexpr std::size_t shown_in_passing = 20;

/// The defect's message, followed by the options that do what it advises.
[[nodiscard]] std::string message_of(const Defect& defect);

/// Whether the surface breaks no rule, and only the choice of kept regions does not suit it.
[[nodiscard]] bool is_valid(const std::vector<Defect>& defects);

/// One line per cause: the number, the worst one, what to do.
[[nodiscard]] std::string summary_text(const DefectSummary& summary);

/// By cause, at most `most` of each: nearly coincident vertices, then the defects. `rest` ends the line that
/// counts those left out ("--all lists them").
[[nodiscard]] std::string list_text(const DefectSummary& summary, const std::vector<Defect>& defects,
                                    std::size_t most, const char* rest);

}  // namespace holdfast::cli
