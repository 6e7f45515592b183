// What pasting is told as.
#pragma once

#include <filesystem>

#include "holdfast/paste.h"

namespace holdfast::cli {

inline constexpr const char* overlap_advice = "--overlap first, last or new says who gets what both hold";

/// Says what came out, and which parts touch no other.
void tell(const PasteResult& result, const std::filesystem::path& output);

}  // namespace holdfast::cli
