// Messages about the result of pasting.
#pragma once

#include <filesystem>

#include "holdfast/paste.h"

namespace holdfast::cli {

inline constexpr const char* overlap_advice =
    "--overlap first, last or new decides which part gets the common space";

/// Reports the result, and parts that touch no other part.
void tell(const PasteResult& result, const std::filesystem::path& output);

}  // namespace holdfast::cli
