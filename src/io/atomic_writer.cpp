// Writes a file under a temporary name and renames it, so that the final name never has a partial file.
#include "io/atomic_writer.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <climits>
#include <cstring>
#include <ctime>
#include <system_error>
#include <utility>

#include "holdfast/io.h"
#include "io/descriptor.h"

namespace holdfast::io {
namespace {

/// Numbers the temporary files of this process; two writers never share one.
std::atomic<unsigned> temporaries{0};

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

constexpr int kAttempts = 100;

/// Bytes written in a few milliseconds.
constexpr std::size_t kChunk = std::size_t{1} << 20;

std::filesystem::path unused_name(const std::filesystem::path& folder) {
  return folder / (".holdfast-" + std::to_string(::getpid()) + "-" + std::to_string(temporaries++) + ".tmp");
}

std::string path_of(int descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

}  // namespace

AtomicWriter::AtomicWriter(std::filesystem::path target, Watch* watch)
    : target_(std::move(target)), watch_(watch), written_(target_), buffer_(new char[kBuffer]) {
  std::error_code error;
  // Symbolic links are followed, as by every program that opens a file for writing, even to a file that does
  // not exist; renaming to the link would replace it.
  constexpr int kMostLinks = 40;
  for (int link = 0;; ++link) {
    if (const std::optional<int> descriptor = descriptor_of(written_)) {
      file_ = copy_of_descriptor(*descriptor);
      if (file_ < 0) fail("cannot be opened for writing", errno);
      struct stat status {};
      may_wait_ = watch_ != nullptr && ::fstat(file_, &status) == 0 &&
                  (S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode));
      return;
    }
    if (!std::filesystem::is_symlink(written_, error)) break;
    if (link == kMostLinks) fail("cannot be written", ELOOP);
    written_ = folder_of(written_) / std::filesystem::read_symlink(written_, error);
    if (error) fail("cannot be written", error.value());
  }
  const auto type = std::filesystem::status(written_, error).type();
  using std::filesystem::file_type;
  if (type == file_type::directory)
    throw FileError(target_, "", "cannot be written: it is a directory", EISDIR);
  if (type == file_type::regular || type == file_type::not_found || type == file_type::none) {
    open_temporary();
  } else {
    open_in_place(type == file_type::fifo);
  }
}

AtomicWriter::~AtomicWriter() {
  if (file_ >= 0) ::close(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

// A named pipe may have no reader yet, for which opening would wait.
void AtomicWriter::open_in_place(bool is_pipe) {
  constexpr timespec kPause{0, 20'000'000};
  const bool asks = is_pipe && watch_ != nullptr;
  for (;;) {
    file_ = ::open(written_.c_str(), O_WRONLY | O_CLOEXEC | (asks ? O_NONBLOCK : 0));
    if (file_ >= 0) break;
    if (errno != EINTR && !(asks && errno == ENXIO)) fail("cannot be opened for writing", errno);
    step(watch_);
    ::nanosleep(&kPause, nullptr);
  }
  may_wait_ = asks;
}

void AtomicWriter::open_temporary() {
#ifdef O_TMPFILE
  // If the system supports files without a name, none is left behind however this process ends. The file gets
  // its name through the folder of open descriptors.
  file_ = ::open(folder_of(written_).c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
  if (file_ >= 0 && ::access(path_of(file_).c_str(), F_OK) != 0) ::close(std::exchange(file_, -1));
#endif
  nameless_ = file_ >= 0;
  if (!nameless_) create_named();
  // A replaced file passes on its permissions; a file system without permissions is no error.
  struct stat existing {};
  if (::stat(written_.c_str(), &existing) == 0) static_cast<void>(::fchmod(file_, existing.st_mode & 07777));
}

void AtomicWriter::create_named() {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    // Store the name before the file exists: a constructor that throws has no destructor.
    temporary_ = unused_name(folder_of(written_));
    file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file_ >= 0 || errno != EEXIST) break;
  }
  if (file_ >= 0) return;
  const int error = errno;
  temporary_.clear();
  if (error == ENOENT) throw FileError(target_, "", "cannot be written: its folder does not exist", error);
  fail("cannot be written: no file can be made in its folder", error);
}

void AtomicWriter::give_name() {
  nameless_ = false;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    temporary_ = unused_name(folder_of(written_));
    if (::linkat(AT_FDCWD, path_of(file_).c_str(), AT_FDCWD, temporary_.c_str(), AT_SYMLINK_FOLLOW) == 0)
      return;
    if (errno != EEXIST) break;
  }
  // A link may be forbidden even if a file is not: then copy the bytes.
  temporary_.clear();
  struct stat status {};
  static_cast<void>(::fstat(file_, &status));
  const int nameless = std::exchange(file_, -1);
  try {
    create_named();
    static_cast<void>(::fchmod(file_, status.st_mode & 07777));
    off_t at = 0;
    for (ssize_t got; (got = ::pread(nameless, buffer_.get(), kBuffer, at)) != 0; at += got) {
      if (got < 0) fail("cannot be written", errno);
      write_through({buffer_.get(), static_cast<std::size_t>(got)});
    }
  } catch (...) {
    ::close(nameless);
    throw;
  }
  ::close(nameless);
}

// Whether a pipe has room soon; its reader may be slow or idle.
bool AtomicWriter::has_room() const {
  constexpr int kMilliseconds = 20;
  pollfd asked{file_, POLLOUT, 0};
  return ::poll(&asked, 1, kMilliseconds) > 0;
}

void AtomicWriter::write_through(std::string_view bytes) {
  while (!bytes.empty()) {
    step(watch_);
    if (may_wait_ && !has_room()) continue;
    const ssize_t written =
        ::write(file_, bytes.data(), std::min(bytes.size(), may_wait_ ? std::size_t{PIPE_BUF} : kChunk));
    if (written < 0 && (errno == EINTR || (may_wait_ && errno == EAGAIN))) continue;
    if (written < 0) fail("cannot be written", errno);
    written_through_ += static_cast<std::uint64_t>(written);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicWriter::patch(std::uint64_t position, std::string_view bytes) {
  flush();
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(position));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("cannot be written", errno);
    position += static_cast<std::uint64_t>(written);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicWriter::flush() {
  const std::size_t used = std::exchange(used_, 0);
  write_through({buffer_.get(), used});
}

void AtomicWriter::write_large(std::string_view bytes) {
  flush();
  if (bytes.size() >= kBuffer) return write_through(bytes);
  bytes.copy(buffer_.get(), bytes.size());
  used_ = bytes.size();
}

AtomicWriter& AtomicWriter::operator<<(double value) {
  char text[32];
  const auto result = std::to_chars(text, text + sizeof text, value);
  return *this << std::string_view(text, static_cast<std::size_t>(result.ptr - text));
}

AtomicWriter& AtomicWriter::operator<<(std::int64_t value) {
  char text[24];
  const auto result = std::to_chars(text, text + sizeof text, value);
  return *this << std::string_view(text, static_cast<std::size_t>(result.ptr - text));
}

AtomicWriter& AtomicWriter::operator<<(std::uint64_t value) {
  char text[24];
  const auto result = std::to_chars(text, text + sizeof text, value);
  return *this << std::string_view(text, static_cast<std::size_t>(result.ptr - text));
}

void AtomicWriter::finish() {
  if (file_ < 0) return;
  flush();
  if (nameless_) give_name();
  const int handle = std::exchange(file_, -1);
  if (::close(handle) != 0 && errno != EINTR) fail("cannot be written", errno);
  buffer_.reset();  // there may be thousands of finished files
}

void AtomicWriter::commit() {
  finish();
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), written_.c_str()) != 0)
    fail("cannot be written: the finished file cannot be renamed", errno);
  temporary_.clear();
}

void AtomicWriter::fail(const char* what, int error) const {
  throw FileError(target_, "", std::string(what) + ": " + std::strerror(error), error);
}

}  // namespace holdfast::io
