// `--fill-holes [N]` and `--union`: what a repair does beside cutting, on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <optional>

#include "holdfast/repair.h"
#include "report.h"

namespace holdfast::cli {

struct RepairWays {
  std::optional<std::size_t> fill_holes;  ///< at most so many sides
  bool unite = false;
};

/// Adds the options; `beside` stands before their help, for a command that repairs only where it is asked to.
void add_repair_ways(CLI::App& command, RepairWays& ways, const std::string& beside = {});

void take_repair_ways(const RepairWays& ways, RepairOptions& options);

/// A number of sides as reports have it; null for none.
[[nodiscard]] Json sides_to_json(const std::optional<std::size_t>& most);

}  // namespace holdfast::cli
