// A whole file in memory.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

namespace holdfast::io {

/// The bytes of a file, read at once.
class FileBytes {
 public:
  /// Reads a regular file or a pipe. Throws FileError, also for directories and devices.
  explicit FileBytes(const std::filesystem::path& path);
  [[nodiscard]] std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

}  // namespace holdfast::io
