// The results of a repair: the parents file, the exact arrangement, a line, and the report.
#pragma once

#include <filesystem>
#include <string>

#include "holdfast/repair.h"
#include "report.h"

namespace holdfast::cli {

/// One sentence for the end of a run.
[[nodiscard]] std::string summary_of(const RepairResult& result);

/// Writes a line for each facet of the output with its parents, "-" for none; does nothing if `path` is
/// empty. Lines that begin with # hold the rest, so that this file suffices to check the result. Throws
/// FileError.
void write_parents(const std::filesystem::path& path, std::size_t input_facets, const RepairResult& result);

/// Writes JSON lines: {"vertex": i, "coordinates": [x, y, z]}, where a coordinate is a number or a text
/// "n/d", then {"facet": [a, b, c], "parents": [...]}; does nothing if `path` is empty. Throws FileError.
void write_exact(const std::filesystem::path& path, const Surface& input, const RepairResult& result);

}  // namespace holdfast::cli
