// The messages of `holdfast mesh` on stderr at the end.
#pragma once

#include <string>

#include "mesh_options.h"

namespace holdfast::cli {

/// For example "1 point" or "2 points".
[[nodiscard]] std::string counted(std::size_t count, const std::string& one, const std::string& many);
[[nodiscard]] inline std::string counted(std::size_t count, const std::string& one) {
  return counted(count, one, one + "s");
}

/// The counts of a run, line by line.
void print_details(const Report& report);

/// Prints warnings and decisions made for the user, one line each.
void print_decisions(const Result& result);

/// Prints the line that ends a run: the volume, its quality, and why it is bad, if so.
void print_summary(const MeshArguments& arguments, const Options& options, const Result& result,
                   double seconds);

}  // namespace holdfast::cli
