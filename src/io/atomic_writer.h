// Writes a file beside its name and renames it, so that a partial file never has that name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "io/watch.h"

namespace holdfast::io {

/// A file that appears under its name complete or not at all.
///
/// Bytes go to a temporary in the target's folder; `commit` closes and renames it. Until
/// then the destructor removes it, so that an exception or a cancellation leaves nothing behind.
/// What is no regular file, a pipe or a device, is written directly, and so is an open descriptor
/// ("/dev/stdout", "/dev/fd/3"), at its place. Every function throws FileError, and Interrupted by the watch.
class AtomicWriter {
 public:
  explicit AtomicWriter(std::filesystem::path target, Watch* watch = nullptr);
  ~AtomicWriter();
  AtomicWriter(AtomicWriter&&) = delete;

  void write(std::string_view bytes) {
    if (bytes.size() > kBuffer - used_) return write_large(bytes);
    bytes.copy(buffer_.get() + used_, bytes.size());
    used_ += bytes.size();
  }
  AtomicWriter& operator<<(std::string_view text) { return write(text), *this; }
  AtomicWriter& operator<<(char c) { return write({&c, 1}), *this; }
  /// The shortest text that reads back as the same double.
  AtomicWriter& operator<<(double value);
  AtomicWriter& operator<<(std::int64_t value);
  AtomicWriter& operator<<(std::uint64_t value);
  AtomicWriter& operator<<(int value) { return *this << std::int64_t{value}; }
  AtomicWriter& operator<<(std::uint32_t value) { return *this << std::uint64_t{value}; }

  /// How many bytes there are by now.
  [[nodiscard]] std::uint64_t position() const { return written_through_ + used_; }
  /// What is written directly may be a pipe.
  [[nodiscard]] bool can_be_patched() const { return nameless_ || !temporary_.empty(); }
  /// Puts bytes in the place of others that were written before.
  void patch(std::uint64_t position, std::string_view bytes);

  [[nodiscard]] Watch* watch() const { return watch_; }
  /// Gives every byte to the system; after it only `commit` may follow. Files that belong together are
  /// all finished before the first is committed.
  void finish();
  /// Finishes the file and gives it its name.
  void commit();

 private:
  static constexpr std::size_t kBuffer = std::size_t{1} << 18;

  void open_temporary();
  void create_named();
  void give_name();
  void write_large(std::string_view bytes);
  void flush();
  void write_through(std::string_view bytes);
  [[nodiscard]] bool has_room() const;
  void open_in_place(bool is_pipe);
  [[noreturn]] void fail(const char* what, int error) const;

  std::filesystem::path target_;
  Watch* watch_;
  std::filesystem::path written_;    ///< the target where its links lead
  std::filesystem::path temporary_;  ///< empty when written directly, committed, or as yet without a name
  bool nameless_ = false;            ///< the file is to get a name when it is complete
  bool may_wait_ = false;            ///< it is a pipe, and there is a watch to be asked meanwhile
  int file_ = -1;
  std::unique_ptr<char[]> buffer_;
  std::size_t used_ = 0;
  std::uint64_t written_through_ = 0;  ///< bytes that have left the buffer
};

}  // namespace holdfast::io
