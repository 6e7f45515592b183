// The report of a run as a file, and messages about it.
#pragma once

#include <filesystem>

#include "holdfast/holdfast.h"
#include "holdfast/names.h"
#include "reports.h"

namespace holdfast::cli {

using reports::Json;
using reports::to_json;

/// The number of vertices that share a place with others or are left out, as in `Report::Input`.
[[nodiscard]] Report::Input count_vertices(const Surface& surface);

/// Reports these in a line on stderr; prints nothing if there are none.
void print_merged(const Report::Input& input);

/// Writes JSON as text; does nothing if `path` is empty. Throws FileError.
void write_json(const std::filesystem::path& path, const Json& json);

/// Prints at most `most` defects to stderr, one per line.
void print_defects(const std::vector<Defect>& defects, std::size_t most);

}  // namespace holdfast::cli
