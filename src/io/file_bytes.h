// A whole file in memory.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "io/watch.h"

namespace holdfast::io {

/// A path without the ".gz" at its end, whose extension tells the format.
[[nodiscard]] std::filesystem::path without_gz(std::filesystem::path path);

/// The file beside `path` with another extension, or with ".gz" behind that if only this one is there.
[[nodiscard]] std::filesystem::path sibling(const std::filesystem::path& path, const char* extension);

/// The bytes of a file, read at once, and unpacked if gzip has packed them.
class FileBytes {
 public:
  /// Reads a regular file, a pipe or an open descriptor ("/dev/stdin"), this from where it stands. Throws
  /// FileError, also for directories and for devices but a terminal, and Interrupted by the watch.
  explicit FileBytes(const std::filesystem::path& path, Watch* watch = nullptr);
  [[nodiscard]] std::string_view view() const {
    return unpacked_ ? std::string_view(*unpacked_) : std::string_view(bytes_.get(), size_);
  }

  /// How many bytes, not all zero, stand behind what gzip has packed, and are no data.
  [[nodiscard]] std::size_t behind() const { return behind_; }

 private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
  std::optional<std::string> unpacked_;  ///< instead, of a packed file
  std::size_t behind_ = 0;
};

}  // namespace holdfast::io
