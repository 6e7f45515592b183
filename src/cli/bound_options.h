// --max-volume and --max-ratio.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "holdfast/holdfast.h"

namespace holdfast::cli {

/// What the user typed.
struct BoundArguments {
  std::vector<std::string> max_volumes;
  std::optional<double> max_ratio;
  std::optional<unsigned> layers;

  [[nodiscard]] bool any() const {
    return !max_volumes.empty() || max_ratio.has_value() || layers.has_value();
  }
};

void add_bounds(CLI::App& command, BoundArguments& arguments);

/// Sets the bounds in the options. A region is given by its id in the mesh or by its name, so the names in
/// the files must be known. Throws UsageError.
void set_bounds(const BoundArguments& arguments, const Names& names, Options& options);

/// Throws UsageError for invalid bounds; reads no file.
void require_bounds(const BoundArguments& arguments);

/// How well the bounds are kept, for the summary of a run; empty without bounds.
[[nodiscard]] std::string bounds_text(const Options& options, const Report& report);

}  // namespace holdfast::cli
