// --order and --curved: elements of second order.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "files_of_run.h"
#include "holdfast/io.h"
#include "report.h"

namespace holdfast::cli {

/// The user's arguments.
struct OrderArguments {
  std::optional<int> order;  ///< none: 1 for a new mesh, and unchanged for a converted file
  std::filesystem::path curved;
  std::optional<double> tolerance;
};

/// Adds --curved and --curved-tolerance; with `add_order` also --order, where it has no other meaning.
void add_curved(CLI::App& command, OrderArguments& arguments);
void add_order(CLI::App& command, OrderArguments& arguments);

/// Throws UsageError for options that make no sense or have no effect; names the file to read.
void take_order(const OrderArguments& arguments, FilesOfRun& files);

/// The smooth surface, if there is one. Throws FileError.
[[nodiscard]] std::optional<Surface> read_curved(const OrderArguments& arguments, const Limits& limits);

/// Warns, unless `quiet`, of elements of second order that are not positive everywhere; returns their number.
std::size_t tell_not_positive(const Volume& volume, const Limits& limits, bool quiet);

/// Gives the volume the requested order, if any: mid-edge nodes for 2, on the smooth surface where possible.
/// Unless `quiet`, reports what stays straight and what is not positive; returns this for the report.
Json set_order(Volume& volume, const OrderArguments& arguments, const std::optional<Surface>& smooth,
               const Limits& limits, bool quiet);

}  // namespace holdfast::cli
