// The numbers of a .msh file, as text or as bytes: one reader serves both.
#pragma once

#include <bit>
#include <limits>

#include "io/byte_reader.h"
#include "io/text_reader.h"

namespace holdfast::io {

/// A cursor over words, which are always text, and numbers. Errors name the line or the byte.
class MshNumbers {
 public:
  explicit MshNumbers(const Source& source) : text_(source, '\0') {}

  /// From now on numbers are bytes in this order; counts and tags of version 4 have `size_bytes` bytes.
  void set_binary(std::endian order, std::size_t size_bytes) {
    binary_ = true;
    order_ = order;
    size_bytes_ = size_bytes;
  }
  /// Numbers follow; bytes start on the next line.
  void begin() {
    if (binary_) text_.skip_line();
  }

  std::int64_t integer(std::string_view what) {
    return binary_ ? take<std::int32_t>(what) : text_.integer(what);
  }
  int tag(std::string_view what) { return binary_ ? take<std::int32_t>(what) : text_.tag(what); }
  double real(std::string_view what) { return binary_ ? take<double>(what) : text_.real(what); }
  Point point() {
    const double x = real("a coordinate"), y = real("a coordinate");
    return {x, y, real("a coordinate")};
  }
  /// A number that version 4 stores as a size.
  std::int64_t size(std::string_view what) {
    if (!binary_) return text_.integer(what);
    if (size_bytes_ == 4) return take<std::uint32_t>(what);
    const auto value = take<std::uint64_t>(what);
    if (value > std::uint64_t{std::numeric_limits<std::int64_t>::max()})
      fail(std::string(what) + " is beyond 63 bits: " + std::to_string(value));
    return static_cast<std::int64_t>(value);
  }
  /// A size that counts items of at least this many bytes as text or as bytes.
  std::size_t count(std::string_view what, std::size_t bytes_text, std::size_t bytes_binary) {
    return binary_ ? counted(size(what), what, bytes_binary) : text_.count(what, bytes_text);
  }
  /// The same for a count that is stored as an integer.
  std::size_t short_count(std::string_view what, std::size_t bytes_text, std::size_t bytes_binary) {
    return binary_ ? counted(integer(what), what, bytes_binary) : text_.count(what, bytes_text);
  }
  /// A count that is text even if numbers are bytes.
  std::size_t text_count(std::string_view what, std::size_t bytes_text, std::size_t bytes_binary) {
    return text_.count(what, binary_ ? bytes_binary : bytes_text);
  }

  /// Throws a FileError for what was read last.
  [[noreturn]] void fail(const std::string& reason) const {
    if (binary_) throw FileError(text_.source().path, "byte " + std::to_string(text_.position()), reason);
    text_.fail(reason);
  }

  [[nodiscard]] bool binary() const { return binary_; }
  [[nodiscard]] std::size_t size_bytes() const { return size_bytes_; }
  TextReader& text() { return text_; }

 private:
  template <typename T>
  T take(std::string_view what) {
    const std::size_t position = text_.position();
    if (text_.remaining().size() < sizeof(T)) text_.fail_truncated(what);
    text_.seek(position + sizeof(T));
    return load<T>(text_.source().bytes.data() + position, order_);
  }
  [[nodiscard]] std::size_t counted(std::int64_t value, std::string_view what, std::size_t bytes_each) const {
    const std::size_t left = text_.source().bytes.size() - text_.position();
    if (value < 0 || static_cast<std::uint64_t>(value) > left / bytes_each)
      fail(std::string(what) + " is " + std::to_string(value) + ", but only " + std::to_string(left) +
           " bytes follow; the file is truncated or damaged");
    return static_cast<std::size_t>(value);
  }

  TextReader text_;
  bool binary_ = false;
  std::endian order_ = std::endian::native;
  std::size_t size_bytes_ = 8;
};

}  // namespace holdfast::io
