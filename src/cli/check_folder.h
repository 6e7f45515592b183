// `holdfast check DIR`: the volumes of a split surface.
#pragma once

#include <filesystem>

#include "holdfast/check.h"

namespace holdfast::cli {

struct FolderCheck {
  std::filesystem::path folder, report;
  CheckOptions options;  ///< limits
  bool quiet = false;
};

/// Checks each part against its own surface and then whether they fit; returns the exit code. Throws
/// FileError for a folder without a readable manifest.
[[nodiscard]] int check_folder(const FolderCheck& what);

}  // namespace holdfast::cli
