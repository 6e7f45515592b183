// The surfaces named on the command line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "holdfast/io.h"

namespace holdfast::cli {

/// Reads surfaces and joins them (`join`). A file without markers gives its facets one marker, with the
/// file's name. With `of_volumes`, the files are volumes whose surfaces are taken. Remarks name their file.
/// Throws FileError, and Interrupted for the limits.
[[nodiscard]] Surface read_surfaces(const std::vector<std::filesystem::path>& paths,
                                    const ReadOptions& options, bool of_volumes = false);

/// Reads the surfaces in the same way, but separately.
[[nodiscard]] std::vector<Surface> read_parts(const std::vector<std::filesystem::path>& paths,
                                              const ReadOptions& options, bool of_volumes = false);

/// Whether a list of formats has this one.
[[nodiscard]] bool is_one_of(const std::vector<std::string>& formats, const std::string& format);

/// The names of files without their folders and endings.
[[nodiscard]] std::vector<std::string> stems(const std::vector<std::filesystem::path>& paths);

/// Prints to stderr what readers and writers left out or changed, one line each, after the name of `file`
/// unless it is empty.
void tell(const std::vector<Remark>& remarks, const std::filesystem::path& file = {});

}  // namespace holdfast::cli
