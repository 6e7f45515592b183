// A file that holds a volume or a surface; its contents decide which.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "files_of_run.h"
#include "holdfast/io.h"

namespace holdfast::cli {

struct AnyMesh {
  bool is_volume = false;  ///< whether `volume`, with tetrahedra, is used instead of `surface`
  Volume volume;
  Surface surface;
  std::vector<Remark> remarks;  ///< from the reader

  [[nodiscard]] Names& names() { return is_volume ? volume.names : surface.names; }
};

/// Whether the format holds volumes; a .node alone is a surface without triangles.
[[nodiscard]] bool may_be_volume(const std::filesystem::path& path, const std::string& format);

/// The files that `read_any` reads, for `files`. Throws UsageError.
void read_any(FilesOfRun& files, const std::filesystem::path& path, const std::string& format);

/// Reads a volume if the file has tetrahedra, otherwise a surface. Reads pipes once. Throws FileError.
[[nodiscard]] AnyMesh read_any(const std::filesystem::path& path, const ReadOptions& options);

/// Where to write, and whether the format holds volumes or only surfaces. Throws UsageError.
struct AnyTarget {
  WriteOptions options;
  bool holds_volumes = false, holds_surfaces = false;
};
[[nodiscard]] AnyTarget write_any(FilesOfRun& files, const char* option, const std::filesystem::path& path,
                                  const std::string& format);

}  // namespace holdfast::cli
