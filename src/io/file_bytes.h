// A whole file in memory.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

namespace holdfast::io {

/// The bytes of a file, read at once.
class FileBytes {
 public:
  /// Reads a regular file, a pipe or an open descriptor ("/dev/stdin"), this from where it stands. Throws
  /// FileError, also for directories and for devices but a terminal.
  explicit FileBytes(const std::filesystem::path& path);
  [[nodiscard]] std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

}  // namespace holdfast::io
