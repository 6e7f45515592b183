// Shared by all fuzz targets: values from the fuzzer's bytes, files, and the end of a failed run.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

#include "holdfast/types.h"

namespace holdfast::fuzz {

/// libFuzzer keeps the input of a process that aborts; the program for stored inputs reports which one it
/// was.
inline void require(bool holds, const std::string& what) {
  if (holds) return;
  std::fprintf(stderr, "FAILED: %s\n", what.c_str());
  std::abort();
}

/// Reads values from the front; zeros after the last byte.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : rest_(data, size) {}

  [[nodiscard]] std::size_t left() const { return rest_.size(); }

  std::uint8_t byte() {
    if (rest_.empty()) return 0;
    const std::uint8_t value = rest_.front();
    rest_ = rest_.subspan(1);
    return value;
  }
  bool flag() { return (byte() & 1u) != 0; }

  /// 0 to count - 1; 0 if there is none.
  Index below(std::size_t count) { return count == 0 ? 0 : static_cast<Index>(byte() % count); }

  /// An arbitrary double, bit by bit.
  double raw() {
    std::uint64_t bits = 0;
    for (int k = 0; k < 8; ++k) bits = bits << 8u | byte();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

  /// Mostly small whole numbers, which often coincide and lie in common planes; sometimes any double.
  double coordinate() {
    const std::uint8_t value = byte();
    if (value == 255) return raw();
    if (value >= 240) return std::ldexp(byte(), (value - 247) * 8);
    return value - 120;
  }

  Point point() {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    return {x, y, z};
  }

  std::string_view text() const { return {reinterpret_cast<const char*>(rest_.data()), rest_.size()}; }

 private:
  std::span<const std::uint8_t> rest_;
};

/// A folder that is removed with the process; in memory if possible.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::is_directory("/dev/shm") ? std::filesystem::path("/dev/shm")
                                                                  : std::filesystem::temp_directory_path()) /
                       "holdfast-fuzz-XXXXXX";
    require(mkdtemp(name.data()) != nullptr, "no temporary folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  void empty() const {
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      std::filesystem::remove(entry.path());
  }

  /// Files "a.EXTENSION", one for each part of `text`; parts are separated by the byte 28 ("file separator").
  void write_parts(std::string_view text, std::span<const char* const> extensions) const {
    for (const char* const extension : extensions) {
      const bool last = extension == extensions.back();
      const std::size_t end = last ? text.size() : std::min(text.find('\x1c'), text.size());
      std::ofstream(path_ / (std::string("a") + extension), std::ios::binary) << text.substr(0, end);
      if (end == text.size()) return;
      text.remove_prefix(end + 1);
    }
  }

 private:
  std::filesystem::path path_;
};

}  // namespace holdfast::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
