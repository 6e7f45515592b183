// A whole file in memory.
#include "io/file_bytes.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <system_error>

#include "holdfast/io.h"

namespace holdfast::io {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

std::unique_ptr<char[]> allocate(const std::filesystem::path& path, std::uintmax_t size) {
  try {
    return std::make_unique_for_overwrite<char[]>(static_cast<std::size_t>(size));
  } catch (const std::bad_alloc&) {
    throw FileError(path, "", "the file (" + std::to_string(size) + " bytes) does not fit in memory");
  }
}

/// What kind of file `path` names, links followed; refuses what cannot hold a mesh.
std::filesystem::file_type checked_type(const std::filesystem::path& path) {
  std::error_code error;
  const auto type = std::filesystem::status(path, error).type();
  using std::filesystem::file_type;
  if (type == file_type::not_found) throw FileError(path, "", "no such file");
  if (error) throw FileError(path, "", "cannot be opened: " + error.message());
  if (type == file_type::directory) throw FileError(path, "", "is a directory, not a file");
  if (type == file_type::block || type == file_type::character)
    throw FileError(path, "", "is a device, not a file");
  return type;
}

}  // namespace

FileBytes::FileBytes(const std::filesystem::path& path) {
  const bool regular = checked_type(path) == std::filesystem::file_type::regular;
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) throw FileError(path, "", std::string("cannot be opened: ") + std::strerror(errno));
  std::error_code error;
  const std::uintmax_t expected = regular ? std::filesystem::file_size(path, error) : 0;
  // One byte more than the file has, so that its end shows without growing the buffer; a pipe, or a
  // file that grows meanwhile, doubles it.
  std::size_t capacity = static_cast<std::size_t>(error ? 0 : expected) + 1;
  if (!regular) capacity = std::size_t{1} << 16;
  bytes_ = allocate(path, capacity);
  for (;;) {
    const std::size_t got = std::fread(bytes_.get() + size_, 1, capacity - size_, file.get());
    size_ += got;
    if (size_ < capacity) break;
    std::unique_ptr<char[]> larger = allocate(path, 2 * capacity);
    std::copy_n(bytes_.get(), size_, larger.get());
    bytes_ = std::move(larger);
    capacity *= 2;
  }
  if (std::ferror(file.get()))
    throw FileError(path, "", std::string("cannot be read: ") + std::strerror(errno));
}

}  // namespace holdfast::io
