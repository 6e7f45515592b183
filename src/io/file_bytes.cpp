// A whole file in memory.
#include "io/file_bytes.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <optional>
#include <system_error>

#include "holdfast/io.h"
#include "io/descriptor.h"
#include "io/gunzip.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Read in a few milliseconds.
constexpr std::size_t kChunk = std::size_t{4} << 20;

std::unique_ptr<char[]> allocate(const std::filesystem::path& path, std::uintmax_t size) {
  try {
    return std::unique_ptr<char[]>(new char[static_cast<std::size_t>(size)]);
  } catch (const std::bad_alloc&) {
    throw FileError(path, "", "the file (" + std::to_string(size) + " bytes) does not fit in memory");
  }
}

/// Refuses what cannot hold a mesh. What someone types is one, other devices have no end.
void require_readable(const std::filesystem::path& path, const struct stat& status, bool is_terminal) {
  if (S_ISDIR(status.st_mode)) throw FileError(path, "", "is a directory, not a file");
  if (S_ISBLK(status.st_mode) || (S_ISCHR(status.st_mode) && !is_terminal))
    throw FileError(path, "", "is a device, not a file");
}

[[noreturn]] void fail(const std::filesystem::path& path, const char* what) {
  throw FileError(path, "", std::string(what) + ": " + std::strerror(errno));
}

/// Opens a file, or an open descriptor at its place.
std::unique_ptr<std::FILE, CloseFile> open(const std::filesystem::path& path) {
  struct stat status {};
  std::unique_ptr<std::FILE, CloseFile> file;
  if (const std::optional<int> descriptor = descriptor_of(path)) {
    if (::fstat(*descriptor, &status) != 0) fail(path, "cannot be opened");
    require_readable(path, status, ::isatty(*descriptor) != 0);
    const int copy = copy_of_descriptor(*descriptor);
    file.reset(copy < 0 ? nullptr : ::fdopen(copy, "rb"));
    if (!file && copy >= 0) ::close(copy);
  } else {
    if (::stat(path.c_str(), &status) != 0) {
      if (errno == ENOENT) throw FileError(path, "", "no such file");
      fail(path, "cannot be opened");
    }
    require_readable(path, status, false);
    file.reset(std::fopen(path.c_str(), "rb"));
  }
  if (!file) fail(path, "cannot be opened");
  return file;
}

/// How many bytes are left to read; nothing for pipes and the like.
std::optional<std::size_t> size_of(std::FILE* file) {
  struct stat status {};
  if (::fstat(::fileno(file), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  const off_t at = ::lseek(::fileno(file), 0, SEEK_CUR);
  return static_cast<std::size_t>(std::max<off_t>(0, status.st_size - std::max<off_t>(0, at)));
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
  const std::unique_ptr<std::FILE, CloseFile> file = open(path);
  const std::optional<std::size_t> expected = size_of(file.get());
  // One byte more than the file has, so that its end shows without growing the buffer; a pipe, or a
  // file that grows meanwhile, doubles it.
  std::size_t capacity = expected ? *expected + 1 : std::size_t{1} << 16;
  bytes_ = allocate(path, capacity);
  for (;;) {
    const std::size_t asked = std::min(capacity - size_, kChunk);
    const std::size_t got = std::fread(bytes_.get() + size_, 1, asked, file.get());
    size_ += got;
    step(watch);
    if (got < asked) break;
    if (size_ < capacity) continue;
    std::unique_ptr<char[]> larger = allocate(path, 2 * capacity);
    std::copy_n(bytes_.get(), size_, larger.get());
    bytes_ = std::move(larger);
    capacity *= 2;
  }
  if (std::ferror(file.get())) fail(path, "cannot be read");
  if (!is_gzip(view())) return;
  Unpacked unpacked = gunzipped({path, view(), false, watch});
  unpacked_ = std::move(unpacked.bytes);
  behind_ = unpacked.behind;
  bytes_.reset();
}

}  // namespace holdfast::io
