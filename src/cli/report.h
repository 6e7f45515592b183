// The report of a run as a file, and what is said of it.
#pragma once

#include <filesystem>

#include "holdfast/holdfast.h"
#include "holdfast/names.h"
#include "reports.h"

namespace holdfast::cli {

using reports::Json;
using reports::to_json;

/// How many vertices of a surface share a place with others or are left out, as `Report::Input` counts them.
[[nodiscard]] Report::Input count_vertices(const Surface& surface);

/// Says so in a line on stderr; nothing where each vertex is a place of its own.
void print_merged(const Report::Input& input);

/// Writes JSON as text; nothing when `path` is empty. Throws FileError.
void write_json(const std::filesystem::path& path, const Json& json);

/// Prints at most `most` defects to stderr, one a line.
void print_defects(const std::vector<Defect>& defects, std::size_t most);

}  // namespace holdfast::cli
