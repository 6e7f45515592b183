// The options of `holdfast mesh` as the command line spells them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "holdfast/holdfast.h"
#include "report.h"

namespace holdfast::cli {

/// What the user typed.
struct MeshArguments {
  std::vector<std::filesystem::path> surfaces;
  std::filesystem::path output, report, exact;
  std::string input_format, format;
  bool fill = false, drop_outside = false, quiet = false, verbose = false;
  std::string keep = "auto";
  std::vector<std::string> holes, regions, without;
  std::string stop_after;
  double size = 0, gradation = Sizes{}.gradation;
  bool no_growth = false;
  std::filesystem::path size_field;
  std::string quality = "good";
  std::uint64_t seed = 1;
  unsigned threads = 1;
  double time_limit = 0;
  double memory_limit = 0;
};

/// The library's options. Throws UsageError that says what is wrong and what is right.
[[nodiscard]] Options to_options(const MeshArguments& arguments);

/// What the user typed, for the report.
[[nodiscard]] Json to_json(const MeshArguments& arguments);

}  // namespace holdfast::cli
