// `--name 3=inlet`: names of markers and regions on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::cli {

/// Adds the option, which may be given several times.
void add_name_option(CLI::App& command, std::vector<std::string>& arguments);

/// What was typed as a table. Throws UsageError.
[[nodiscard]] Names names_of(const std::vector<std::string>& arguments);

/// Puts `names` in, which count where `into` has others.
void merge(Names& into, const Names& names);

}  // namespace holdfast::cli
