// Surfaces of the command line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "holdfast/io.h"

namespace holdfast::cli {

/// Reads surfaces and puts them together (`join`): a file without markers gives its facets one with its name.
/// With `of_volumes`, files are volumes, of which the surface is taken. Remarks begin with their file. Throws
/// FileError, and Interrupted for the limits.
[[nodiscard]] Surface read_surfaces(const std::vector<std::filesystem::path>& paths,
                                    const ReadOptions& options, bool of_volumes = false);

/// The surfaces by themselves, in the same way.
[[nodiscard]] std::vector<Surface> read_parts(const std::vector<std::filesystem::path>& paths,
                                              const ReadOptions& options, bool of_volumes = false);

/// The names of files without their folders and endings.
[[nodiscard]] std::vector<std::string> stems(const std::vector<std::filesystem::path>& paths);

/// Prints what readers and writers left out or changed, one line each, on stderr; behind the name of a file
/// unless it is empty.
void tell(const std::vector<Remark>& remarks, const std::filesystem::path& file = {});

}  // namespace holdfast::cli
