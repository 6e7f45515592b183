// `--paste[=T]` and `--overlap`: parts that touch, on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "holdfast/paste.h"

namespace holdfast::cli {

/// Adds a flag with an optional value after "=", so that files can follow it. The value is empty if not
/// given.
void add_paste_option(CLI::App& command, std::optional<std::string>& tolerance);
void add_overlap_option(CLI::App& command, std::optional<std::string>& overlap);

/// Throws UsageError for anything but first, last and new.
[[nodiscard]] Overlap overlap_named(const std::optional<std::string>& text);

/// The value of a tolerance. Throws UsageError, naming `option`, if it is not positive.
[[nodiscard]] double tolerance_of(const std::string& text, const std::string& option);

/// The names of files in messages.
[[nodiscard]] std::vector<std::string> labels_of(const std::vector<std::filesystem::path>& paths);

}  // namespace holdfast::cli
