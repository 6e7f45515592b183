// `--paste[=T]` and `--overlap`: parts that touch, on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "holdfast/paste.h"

namespace holdfast::cli {

/// A flag that may have a value behind "=", so that files can follow it. Empty for none.
void add_paste_option(CLI::App& command, std::optional<std::string>& tolerance);
void add_overlap_option(CLI::App& command, std::optional<std::string>& overlap);

/// Throws UsageError for what is none of first, last and new.
[[nodiscard]] Overlap overlap_named(const std::optional<std::string>& text);

/// What a tolerance was given as. Throws UsageError for `option` if it is not positive.
[[nodiscard]] double tolerance_of(const std::string& text, const std::string& option);

/// The files as messages call them.
[[nodiscard]] std::vector<std::string> labels_of(const std::vector<std::filesystem::path>& paths);

}  // namespace holdfast::cli
