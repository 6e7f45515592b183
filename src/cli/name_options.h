// `--name 3=inlet`: names of markers and regions on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <set>
#include <string>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::cli {

/// Adds the option, which may be given several times.
void add_name_option(CLI::App& command, std::vector<std::string>& arguments);

/// The arguments as a table. Throws UsageError.
[[nodiscard]] Names names_of(const std::vector<std::string>& arguments);

/// The markers and region ids that occur.
struct Nameable {
  std::set<int> facets, regions, segments, vertices;
  bool regions_are_known = true;  ///< false for a surface without seeds, whose mesh numbers the regions
};
[[nodiscard]] Nameable nameable_in(const Volume& volume);
[[nodiscard]] Nameable nameable_in(const Surface& surface);

/// Reports names that belong to no marker or region.
void tell_idle_names(const std::vector<std::string>& arguments, const Nameable& there);

/// Merges `names`, which take precedence over those of `into`.
void merge(Names& into, const Names& names);

}  // namespace holdfast::cli
