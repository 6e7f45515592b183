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

/// What the user typed.
struct OrderArguments {
  std::optional<int> order;  ///< none: 1 for what is made, and what a file has for what is converted
  std::filesystem::path curved;
  std::optional<double> tolerance;
};

/// --curved and --curved-tolerance; `add_order` has --order, too, where it means nothing else.
void add_curved(CLI::App& command, OrderArguments& arguments);
void add_order(CLI::App& command, OrderArguments& arguments);

/// Throws UsageError for options that make no sense or do nothing; names the file that is read.
void take_order(const OrderArguments& arguments, FilesOfRun& files);

/// The smooth surface, if there is one. Throws FileError.
[[nodiscard]] std::optional<Surface> read_curved(const OrderArguments& arguments, const Limits& limits);

/// Warns, unless `quiet`, of elements of second order that are not positive everywhere; returns how many
/// there are.
std::size_t tell_not_positive(const Volume& volume, const Limits& limits, bool quiet);

/// Gives the volume the order that was asked for, if one was: mid-edge nodes if 2, on the smooth surface
/// where they can be. Tells what stayed straight, and what is not positive, unless `quiet`; returns it for
/// the report.
Json set_order(Volume& volume, const OrderArguments& arguments, const std::optional<Surface>& smooth,
               const Limits& limits, bool quiet);

}  // namespace holdfast::cli
