// A repair before the mesh: `holdfast mesh --repair`.
#pragma once

#include <filesystem>

#include "holdfast/io.h"
#include "holdfast/repair.h"
#include "progress.h"

namespace holdfast::cli {

/// Repairs a surface; the result takes over its seeds and remarks.
[[nodiscard]] RepairResult repair_before(const Surface& given, RepairOptions options, ProgressView& progress);

/// Copies the seeds and remarks of a surface to the repaired one.
void take_seeds(const Surface& given, Surface& repaired);

/// Reports why a repair ended without a surface; returns the exit code.
[[nodiscard]] int conclude_repair(const RepairResult& result);

/// Writes the meshed surface, unless a limit ended the mesh or `path` is empty.
void write_repaired(const std::filesystem::path& path, const Surface& surface, Outcome outcome,
                    const WriteOptions& options, bool quiet);

}  // namespace holdfast::cli
