// Writes a file beside its target and then renames it, so that the target's name never belongs to a partial
// file.
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
/// Bytes go to a temporary file in the target's folder; `commit` closes and renames it. Without a commit the
/// destructor removes it, so that an exception or a cancellation leaves nothing behind. A target that is not
/// a regular file (a pipe, a device) is written directly, and so is an open descriptor ("/dev/stdout",
/// "/dev/fd/3"), from its current position on. Every function throws FileError, and the watch throws
/// Interrupted.
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
  /// Writes the shortest text that reads back as the same double.
  AtomicWriter& operator<<(double value);
  AtomicWriter& operator<<(std::int64_t value);
  AtomicWriter& operator<<(std::uint64_t value);
  AtomicWriter& operator<<(int value) { return *this << std::int64_t{value}; }
  AtomicWriter& operator<<(std::uint32_t value) { return *this << std::uint64_t{value}; }

  /// The number of bytes written so far.
  [[nodiscard]] std::uint64_t position() const { return written_through_ + used_; }
  /// False for a target that is written directly: it may be a pipe.
  [[nodiscard]] bool can_be_patched() const { return nameless_ || !temporary_.empty(); }
  /// Overwrites bytes that were written before.
  void patch(std::uint64_t position, std::string_view bytes);

  [[nodiscard]] Watch* watch() const { return watch_; }
  /// Gives all bytes to the system; only `commit` may follow. Files that belong together are all finished
  /// before the first of them is committed.
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
  std::filesystem::path written_;    ///< the target with its links resolved
  std::filesystem::path temporary_;  ///< empty if written directly, committed, or still without a name
  bool nameless_ = false;            ///< the file gets its name when it is complete
  bool may_wait_ = false;            ///< a pipe, with a watch to poll while it blocks
  int file_ = -1;
  std::unique_ptr<char[]> buffer_;
  std::size_t used_ = 0;
  std::uint64_t written_through_ = 0;  ///< bytes that have left the buffer
};

}  // namespace holdfast::io
