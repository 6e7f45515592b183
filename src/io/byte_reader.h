// Reads numbers of a given byte order from bytes in memory.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

#include "io/mesh_data.h"

namespace holdfast::io {

/// The number whose bytes start at `bytes`, in the byte order `order`.
template <typename T>
[[nodiscard]] T load(const char* bytes, std::endian order) {
  static_assert(std::is_arithmetic_v<T>);
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes, sizeof(T));
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

/// Appends the bytes of a number in the byte order `order`.
template <typename T>
void store(std::string& bytes, T value, std::endian order) {
  static_assert(std::is_arithmetic_v<T>);
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

/// A cursor over bytes. Errors are FileErrors with the byte's offset in the file.
class ByteReader {
 public:
  ByteReader(const Source& source, std::endian order, std::size_t position = 0)
      : source_(source), order_(order), position_(position) {}

  template <typename T>
  T read() {
    require(sizeof(T));
    beat(source_.watch);
    const T value = load<T>(source_.bytes.data() + position_, order_);
    position_ += sizeof(T);
    return value;
  }
  /// The next `count` bytes.
  std::string_view take(std::size_t count) {
    require(count);
    position_ += count;
    return source_.bytes.substr(position_ - count, count);
  }
  /// Throws unless `count` items of `bytes_each` bytes follow, so that a reader may reserve memory for them.
  void require_items(std::uint64_t count, std::size_t bytes_each, const char* what) const {
    if (count > left() / bytes_each)
      fail(std::to_string(count) + " " + what + " are announced, but only " + std::to_string(left()) +
           " bytes follow; the file is truncated or damaged");
  }
  [[nodiscard]] std::size_t left() const { return source_.bytes.size() - position_; }
  [[nodiscard]] std::size_t position() const { return position_; }
  [[nodiscard]] std::endian order() const { return order_; }
  void seek(std::size_t position) { position_ = position; }

  [[noreturn]] void fail(const std::string& reason) const {
    throw FileError(source_.path, "byte " + std::to_string(position_), reason);
  }

 private:
  void require(std::size_t count) const {
    if (count > left()) fail("the file ends too early; it is truncated");
  }

  Source source_;
  std::endian order_;
  std::size_t position_;
};

}  // namespace holdfast::io
