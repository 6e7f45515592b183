// `--fill-holes [N]` and `--union`: what a repair does besides cutting, on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <optional>

#include "holdfast/repair.h"
#include "report.h"

namespace holdfast::cli {

struct RepairWays {
  std::optional<std::size_t> fill_holes;  ///< the most sides of a hole
  bool unite = false;
};

/// Adds the options; `beside` precedes their help, for a command that repairs only on request.
void add_repair_ways(CLI::App& command, RepairWays& ways, const std::string& beside = {});

void take_repair_ways(const RepairWays& ways, RepairOptions& options);

/// The distance within which --repair[=T] joins vertices: 0 for "true", without T. Throws UsageError.
[[nodiscard]] double weld_of(const std::string& repair);

/// The number of sides for reports; null for none.
[[nodiscard]] Json sides_to_json(const std::optional<std::size_t>& most);

}  // namespace holdfast::cli
