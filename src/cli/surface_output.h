// The output of `repair` and `paste`: a surface, and an account of its origin.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "holdfast/surface_io.h"

namespace holdfast::cli {

struct SurfaceOutput {
  std::filesystem::path output, parents, report;
  std::string format;
};

/// Adds -o.
void add_surface_output(CLI::App& command, SurfaceOutput& output);
/// Adds --parents and --report.
void add_account(CLI::App& command, SurfaceOutput& output);
/// Adds --format.
void add_surface_format(CLI::App& command, SurfaceOutput& output);

/// Whether the format has a place for seeds.
[[nodiscard]] bool holds_seeds(const SurfaceOutput& output, const WriteOptions& options);

/// Writes the surface and, unless `quiet`, reports what its format does not hold. Throws FileError and
/// Interrupted.
void write_and_tell(const SurfaceOutput& output, const Surface& surface, const WriteOptions& options,
                    bool quiet);

}  // namespace holdfast::cli
