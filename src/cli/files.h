// Files of the command line: surfaces in, volumes and text out, and the checks made before long work.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "holdfast/io.h"

namespace holdfast::cli {

/// Reads surfaces and joins them. A vertex that has the same coordinates (+0 and -0 are one) as a vertex of
/// an earlier file becomes that vertex. Where no file carries markers, facets are marked with the number of
/// their file, from 1. Throws FileError.
[[nodiscard]] Surface read_surfaces(const std::vector<std::filesystem::path>& paths, std::string_view format);

/// Reads points: the vertices of any surface file, or an .xyz text (three numbers a line, what follows them
/// on the line is ignored). Throws FileError.
[[nodiscard]] std::vector<Point> read_points(const std::filesystem::path& path);

/// Where and how to write a volume.
struct VolumeTarget {
  std::filesystem::path path;
  WriteOptions options;
};

/// Checks, before any work is done, that a volume can be written to `path`: the format (`format`, or the
/// extension when it is empty) is known, the folder takes files, and no input would be overwritten.
/// Throws UsageError or FileError.
[[nodiscard]] VolumeTarget volume_target(const std::filesystem::path& path, std::string format,
                                         const std::vector<std::filesystem::path>& inputs);

/// Throws FileError unless a file can be created beside `path`. An empty path is fine: nothing to write.
void require_writable(const std::filesystem::path& path);

/// Writes `text` beside `path` and renames it. Throws FileError.
void write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace holdfast::cli
