// What `holdfast mesh` says on standard error when it is done.
#pragma once

#include <string>

#include "mesh_options.h"

namespace holdfast::cli {

/// "1 point", "2 points".
[[nodiscard]] std::string counted(std::size_t count, const std::string& one, const std::string& many);
[[nodiscard]] inline std::string counted(std::size_t count, const std::string& one) {
  return counted(count, one, one + "s");
}

/// The counts of a run, line by line.
void print_details(const Report& report);

/// Warnings and what was decided for the user, a line each.
void print_decisions(const Result& result);

/// One line that ends a run: the volume, its quality, and why that is bad if it is.
void print_summary(const MeshArguments& arguments, const Options& options, const Result& result,
                   double seconds);

}  // namespace holdfast::cli
