// Holdfast: reading surfaces, reading and writing volumes (design §3.2).
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "holdfast/types.h"

namespace holdfast {

/// A file that cannot be read or written: what, where in it, and why.
class FileError : public std::runtime_error {
 public:
  FileError(std::filesystem::path path, std::string where, const std::string& reason)
      : std::runtime_error(path.string() + (where.empty() ? "" : ": " + where) + ": " + reason),
        path_(std::move(path)),
        where_(std::move(where)) {}
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// "line 12", "byte 84" or empty.
  [[nodiscard]] const std::string& where() const { return where_; }

 private:
  std::filesystem::path path_;
  std::string where_;
};

/// Reads a surface; the format follows the extension unless `format` (".stl", ...) is given.
///
/// .stl (ASCII and binary), .off, .obj, .ply, .mesh, .poly, .smesh. Vertices of .stl with identical
/// coordinates (+0 and -0 are one) are welded, nothing else is. Polygons with more than three
/// corners are refused where the format does not say how to split them, except convex ones, which
/// are fanned. Throws FileError.
[[nodiscard]] Surface read_surface(const std::filesystem::path& path, std::string_view format = {});

/// Reads a volume: .vtu, .vtk, .mesh, .msh, .node/.ele. Throws FileError.
[[nodiscard]] Volume read_volume(const std::filesystem::path& path, std::string_view format = {});

struct WriteOptions {
  bool compress = true;     ///< .vtu: zlib blocks
  bool legacy_msh = false;  ///< .msh: version 2.2 instead of 4.1
  std::string format;       ///< overrides the extension
};

/// Writes a volume beside its name and renames it, so that no partial file is ever left.
///
/// .vtu (binary appended), .vtk, .mesh, .msh, .node/.ele/.face. Throws FileError.
void write_volume(const std::filesystem::path& path, const Volume& volume,
                  const WriteOptions& options = {});

/// Writes the places of defects as points and lines for a viewer (.vtu). Throws FileError.
void write_marks(const std::filesystem::path& path, const Complex& complex,
                 std::span<const Defect> defects);

}  // namespace holdfast
