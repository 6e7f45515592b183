// The files that a file names.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "io/mesh_data.h"

namespace holdfast::io {

using ListFiles = std::function<std::vector<std::filesystem::path>(const Source&)>;

/// A file, and the files that it names, as `named` lists them. The file alone if it is a pipe, which can only
/// be read once, or cannot be read, which the reader reports.
[[nodiscard]] std::vector<std::filesystem::path> with_named_files(const std::filesystem::path& path,
                                                                  const ListFiles& named);

}  // namespace holdfast::io
