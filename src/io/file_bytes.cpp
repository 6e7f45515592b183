// Reads a whole file into memory.
#include "io/file_bytes.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <optional>
#include <system_error>

#include "holdfast/io.h"
#include "io/descriptor.h"
#include "io/gunzip.h"
#include "io/text_reader.h"
#include "io/utf16.h"
#include "text/count.h"

namespace holdfast::io {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }

  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

/// Bytes read in a few milliseconds.
constexpr std::size_t kReadAtOnce = std::size_t{4} << 20;

std::unique_ptr<char[]> allocate(const std::filesystem::path& path, std::uintmax_t size) {
  try {
    return std::unique_ptr<char[]>(new char[static_cast<std::size_t>(size)]);
  } catch (const std::bad_alloc&) {
    throw FileError(path, "", "the file (" + counted(size, "byte") + ") does not fit in memory");
  }
}

/// Refuses what cannot hold a mesh. A terminal is accepted; other devices have no end.
void require_readable(const std::filesystem::path& path, const struct stat& status, bool is_terminal) {
  if (S_ISDIR(status.st_mode)) throw FileError(path, "", "is a directory, not a file", EISDIR);
  if (S_ISBLK(status.st_mode) || (S_ISCHR(status.st_mode) && !is_terminal))
    throw FileError(path, "", "is a device, not a file");
}

[[noreturn]] void fail(const std::filesystem::path& path, const char* what) {
  const int error = errno;
  throw FileError(path, "", std::string(what) + ": " + std::strerror(error), error);
}

/// Opens a file, or an open descriptor at its position. A named pipe may have no writer yet, for which
/// opening would wait.
Descriptor open(const std::filesystem::path& path) {
  struct stat status {};
  int number = -1;
  if (const std::optional<int> descriptor = descriptor_of(path)) {
    if (::fstat(*descriptor, &status) != 0) fail(path, "cannot be opened");
    require_readable(path, status, ::isatty(*descriptor) != 0);
    number = copy_of_descriptor(*descriptor);
  } else {
    if (::stat(path.c_str(), &status) != 0) {
      if (errno == ENOENT) throw FileError(path, "", "no such file", ENOENT);
      fail(path, "cannot be opened");
    }
    require_readable(path, status, false);
    number = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | (S_ISFIFO(status.st_mode) ? O_NONBLOCK : 0));
  }
  if (number < 0) fail(path, "cannot be opened");
  return Descriptor(number);
}

/// The number of bytes left to read; nullopt for pipes and the like.
std::optional<std::size_t> size_of(const Descriptor& file) {
  struct stat status {};
  if (::fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  const off_t at = ::lseek(file.number(), 0, SEEK_CUR);
  return static_cast<std::size_t>(std::max<off_t>(0, status.st_size - std::max<off_t>(0, at)));
}

/// Waits until there is something to read or the other end is closed, for pipes and others that may be idle
/// for long.
void wait_for_bytes(const Descriptor& file, Watch* watch) {
  constexpr int kMilliseconds = 20;
  pollfd asked{file.number(), POLLIN, 0};
  while (::poll(&asked, 1, kMilliseconds) <= 0) step(watch);
}

/// Reads at most `most` bytes; returns 0 at the end.
std::size_t read_some(const std::filesystem::path& path, const Descriptor& file, char* to, std::size_t most,
                      bool may_wait, Watch* watch) {
  for (;;) {
    if (may_wait) wait_for_bytes(file, watch);
    const ssize_t got = ::read(file.number(), to, most);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR && errno != EAGAIN) fail(path, "cannot be read");
  }
}

}  // namespace

std::filesystem::path without_gz(std::filesystem::path path) {
  return lower(path.extension().string()) == ".gz" ? path.replace_extension() : path;
}

std::filesystem::path sibling(const std::filesystem::path& path, const char* extension) {
  std::filesystem::path plain = without_gz(path).replace_extension(extension);
  std::filesystem::path packed = plain;
  packed += ".gz";
  std::error_code error;
  return !std::filesystem::exists(plain, error) && std::filesystem::exists(packed, error) ? packed : plain;
}

FileBytes::FileBytes(const std::filesystem::path& path, Watch* watch) {
  const Descriptor file = open(path);
  const std::optional<std::size_t> expected = size_of(file);
  // One byte more than the file has shows its end without growing the buffer; for a pipe, or a file that
  // grows meanwhile, the buffer doubles.
  std::size_t capacity = expected ? *expected + 1 : std::size_t{1} << 16;
  bytes_ = allocate(path, capacity);
  for (;;) {
    const std::size_t asked = std::min(capacity - size_, kReadAtOnce);
    const std::size_t got = read_some(path, file, bytes_.get() + size_, asked, !expected, watch);
    size_ += got;
    step(watch);
    if (got == 0) break;
    if (size_ < capacity) continue;
    std::unique_ptr<char[]> larger = allocate(path, 2 * capacity);
    std::copy_n(bytes_.get(), size_, larger.get());
    bytes_ = std::move(larger);
    capacity *= 2;
  }
  if (is_gzip(view())) {
    Unpacked unpacked = gunzipped({path, view(), false, watch});
    unpacked_ = std::move(unpacked.bytes);
    behind_ = unpacked.behind;
  }
  if (std::optional<std::string> text = from_utf16(view())) unpacked_ = std::move(text);
  if (unpacked_) bytes_.reset();
}

}  // namespace holdfast::io
