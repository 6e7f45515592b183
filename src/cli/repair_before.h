// A repair before the mesh: `holdfast mesh --repair`.
#pragma once

#include <filesystem>

#include "holdfast/io.h"
#include "holdfast/repair.h"
#include "progress.h"

namespace holdfast::cli {

/// The surface of the result has the given one's seeds and remarks.
[[nodiscard]] RepairResult repair_before(const Surface& given, RepairOptions options, ProgressView& progress);

/// Seeds and remarks of a surface for what it was repaired to.
void take_seeds(const Surface& given, Surface& repaired);

/// Says why a repair ended without a surface; returns the exit code.
[[nodiscard]] int conclude_repair(const RepairResult& result);

/// Writes the surface that was meshed, unless a limit ended the mesh. Nothing where `path` is empty.
void write_repaired(const std::filesystem::path& path, const Surface& surface, Outcome outcome,
                    const WriteOptions& options, bool quiet);

}  // namespace holdfast::cli
