// A whole file in memory.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "io/watch.h"

namespace holdfast::io {

/// A path without a final ".gz"; its extension then determines the format.
[[nodiscard]] std::filesystem::path without_gz(std::filesystem::path path);

/// The file beside `path` with another extension, or that name with ".gz" if only this file exists.
[[nodiscard]] std::filesystem::path sibling(const std::filesystem::path& path, const char* extension);

/// The bytes of a file, read at once, unpacked if gzip has packed them, and converted if they are text in
/// UTF-16: all readers expect UTF-8.
class FileBytes {
 public:
  /// Reads a regular file, a pipe or an open descriptor ("/dev/stdin"), the latter from its current position.
  /// Throws FileError, also for directories and for devices other than a terminal. The watch throws
  /// Interrupted.
  explicit FileBytes(const std::filesystem::path& path, Watch* watch = nullptr);
  [[nodiscard]] std::string_view view() const {
    return unpacked_ ? std::string_view(*unpacked_) : std::string_view(bytes_.get(), size_);
  }

  /// The number of bytes after the gzip data, if they are not all zero. They are not data.
  [[nodiscard]] std::size_t behind() const { return behind_; }

 private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
  std::optional<std::string> unpacked_;  ///< of a compressed or converted file, instead
  std::size_t behind_ = 0;
};

}  // namespace holdfast::io
