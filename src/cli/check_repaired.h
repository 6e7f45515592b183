// `holdfast check --repaired`: whether a repaired surface keeps the promise for its input.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "holdfast/limits.h"

namespace holdfast::cli {

struct RepairedFiles {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path output, parents, report, verdict;
  std::string input_format, format;
};

/// Lists the rules and returns the exit code.
[[nodiscard]] int check_repaired_files(const RepairedFiles& files, const Limits& limits, bool quiet);

}  // namespace holdfast::cli
