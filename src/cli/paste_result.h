// What pasting is told as.
#pragma once

#include <filesystem>

#include "holdfast/paste.h"
#include "report.h"

namespace holdfast::cli {

inline constexpr const char* overlap_advice = "--overlap first, last or new says who gets what both hold";

/// The parts, for a report.
[[nodiscard]] Json parts_of(const PasteResult& pasted);

/// The report of a repair, and parts, overlaps and distances.
[[nodiscard]] Json report_of(const PasteResult& result, Json options);

/// Says what came out, and which parts touch no other.
void tell(const PasteResult& result, const std::filesystem::path& output);

}  // namespace holdfast::cli
