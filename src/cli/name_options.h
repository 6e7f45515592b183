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

/// What was typed as a table. Throws UsageError.
[[nodiscard]] Names names_of(const std::vector<std::string>& arguments);

/// Markers and ids of regions that something has.
struct Nameable {
  std::set<int> facets, regions, segments, vertices;
  bool regions_are_known = true;  ///< not of a surface without seeds, whose mesh numbers them
};
[[nodiscard]] Nameable nameable_in(const Volume& volume);
[[nodiscard]] Nameable nameable_in(const Surface& surface);

/// Says which of the names nothing has.
void tell_idle_names(const std::vector<std::string>& arguments, const Nameable& there);

/// Puts `names` in, which count where `into` has others.
void merge(Names& into, const Names& names);

}  // namespace holdfast::cli
