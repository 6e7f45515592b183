// Messages about the result of pasting.
#pragma once

#include <filesystem>

#include "holdfast/paste.h"

namespace holdfast::cli {

inline constexpr const char* overlap_advice = "--overlap first, last or new says who gets what both hold";

/// Reports the result, and parts that touch no other part.
void tell(const PasteResult& result, const std::filesystem::path& output);

}  // namespace holdfast::cli
