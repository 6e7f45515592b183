// The manifest of a divided surface: `split` writes it, `join` and `check DIR` read it (docs/divide.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "holdfast/divide.h"
#include "report.h"

namespace holdfast::cli {

struct ManifestPart {
  std::filesystem::path surface, volume;  ///< names relative to the folder
  std::string checksum;                   ///< of the surface's bytes
};

struct Manifest {
  std::filesystem::path folder;
  std::filesystem::path surface;  ///< the whole, relative to the folder
  std::string checksum;
  int interface_marker = 0;
  bool outside_dropped = false;
  Names names;
  std::vector<ManifestPart> parts;

  [[nodiscard]] std::filesystem::path path_of(const std::filesystem::path& file) const {
    return folder / file;
  }
};

inline constexpr const char* manifest_name = "manifest.json";

/// CRC-32 of a file's bytes as eight hexadecimal digits. Throws FileError.
[[nodiscard]] std::string checksum_of(const std::filesystem::path& file);

/// Throws FileError, also for a manifest of another kind and for names that lead out of the folder.
[[nodiscard]] Manifest read_manifest(const std::filesystem::path& folder);

/// The divided surface, with its names. Throws FileError, and Stale if the file has changed.
[[nodiscard]] Surface whole_of(const Manifest& manifest, const Limits& limits);

/// A file of a division differs from what the manifest says.
class Stale : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The volume of part k, which begins with the vertices of its surface. Throws FileError and Stale.
[[nodiscard]] Volume volume_of(const Manifest& manifest, std::size_t k, const Limits& limits);
/// The surface of part k. Throws FileError and Stale.
[[nodiscard]] Surface surface_of_part(const Manifest& manifest, std::size_t k, const Limits& limits);

}  // namespace holdfast::cli
