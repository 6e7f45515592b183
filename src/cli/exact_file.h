// A mesh with exact coordinates, for inputs without a positive mesh in doubles.
#pragma once

#include <filesystem>

#include "holdfast/holdfast.h"

namespace holdfast::cli {

/// Writes JSON lines: {"vertex": i, "coordinates": [x, y, z]}, where a coordinate is a number (a double) or a
/// text "m*2^e" (exact), then {"tetrahedron": [a, b, c, d], "region": r}. Throws FileError.
void write_exact(const std::filesystem::path& path, const Result& result);

}  // namespace holdfast::cli
