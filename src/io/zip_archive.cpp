#include "io/zip_archive.h"

#include <zlib.h>

#include <limits>

#include "io/byte_reader.h"
#include "io/gunzip.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

// Sections 4.3.6 to 4.3.16 of the specification; the 64-bit records exist if 32 bits do not suffice.
constexpr std::string_view kFileHeader = "PK\x03\x04", kDirectoryEntry = "PK\x01\x02", kZipEnd = "PK\x05\x06",
                           kEnd64 = "PK\x06\x06", kEnd64Locator = "PK\x06\x07";
constexpr std::size_t kEnd64LocatorSize = 20;
constexpr std::uint16_t kExtra64 = 1, kStored = 0, kDeflated = 8, kEncrypted = 1;
constexpr std::uint32_t kIn64 = std::numeric_limits<std::uint32_t>::max();

/// A reader after the signature of the record at `position`, which must be there.
ByteReader record(const Source& source, std::uint64_t position, std::string_view mark, const char* what) {
  if (position > source.bytes.size() || !source.bytes.substr(position).starts_with(mark))
    throw FileError(source.path, "byte " + std::to_string(position),
                    std::string("the archive has no ") + what + " here; the file is truncated or damaged");
  return {source, std::endian::little, static_cast<std::size_t>(position) + mark.size()};
}

struct Directory {
  std::uint64_t entries = 0, position = 0;
};

/// The archive's directory, from the record at its end; a comment may follow that.
Directory directory_of(const Source& source) {
  const std::size_t end = source.bytes.rfind(kZipEnd);
  if (end == std::string_view::npos)
    throw FileError(source.path, "byte " + std::to_string(source.bytes.size()),
                    "the archive ends without its directory; the file is truncated");
  ByteReader bytes = record(source, end, kZipEnd, "end");
  bytes.take(6);  // numbers of disks, and entries on this one
  Directory directory;
  directory.entries = bytes.read<std::uint16_t>();
  bytes.take(4);
  directory.position = bytes.read<std::uint32_t>();
  bytes.take(2);  // length of the comment
  if (end < kEnd64LocatorSize || !source.bytes.substr(end - kEnd64LocatorSize).starts_with(kEnd64Locator))
    return directory;
  ByteReader locator = record(source, end - kEnd64LocatorSize, kEnd64Locator, "locator");
  locator.take(4);
  ByteReader wide = record(source, locator.read<std::uint64_t>(), kEnd64, "end of 64 bits");
  wide.take(28);
  directory.entries = wide.read<std::uint64_t>();
  wide.take(8);
  directory.position = wide.read<std::uint64_t>();
  return directory;
}

/// Reads 64-bit sizes and offset, in the order in which the record omitted them.
void read_wide(ByteReader extra, std::size_t end, ZipArchive::Entry& entry) {
  while (extra.position() + 4 <= end) {
    const auto kind = extra.read<std::uint16_t>();
    const auto size = extra.read<std::uint16_t>();
    const std::size_t next = extra.position() + size;
    if (kind == kExtra64)
      for (std::uint64_t* value : {&entry.size, &entry.packed, &entry.header})
        if (*value == kIn64 && extra.position() + 8 <= next) *value = extra.read<std::uint64_t>();
    extra.seek(std::min(next, end));
  }
}

ZipArchive::Entry read_entry(ByteReader& bytes) {
  ZipArchive::Entry entry;
  bytes.take(4);  // versions
  entry.flags = bytes.read<std::uint16_t>();
  entry.method = bytes.read<std::uint16_t>();
  bytes.take(4);  // time
  entry.checksum = bytes.read<std::uint32_t>();
  entry.packed = bytes.read<std::uint32_t>();
  entry.size = bytes.read<std::uint32_t>();
  const auto name = bytes.read<std::uint16_t>(), extra = bytes.read<std::uint16_t>(),
             comment = bytes.read<std::uint16_t>();
  bytes.take(8);  // disk and attributes
  entry.header = bytes.read<std::uint32_t>();
  entry.name = bytes.take(name);
  const ByteReader at_extra = bytes;
  bytes.take(extra);
  read_wide(at_extra, bytes.position(), entry);
  bytes.take(comment);
  return entry;
}

}  // namespace

std::string ZipArchive::key_of(std::string_view name) {
  while (name.starts_with('/')) name.remove_prefix(1);
  return lower(name);
}

ZipArchive::ZipArchive(const Source& source) : source_(source) {
  const Directory directory = directory_of(source);
  std::uint64_t position = directory.position;
  for (std::uint64_t i = 0; i < directory.entries; ++i) {
    ByteReader bytes = record(source, position, kDirectoryEntry, "entry of its directory");
    Entry entry = read_entry(bytes);
    position = bytes.position();
    std::string key = key_of(entry.name);
    entries_.insert_or_assign(std::move(key), std::move(entry));
  }
}

const ZipArchive::Entry* ZipArchive::find(std::string_view name) const {
  const auto found = entries_.find(key_of(name));
  return found == entries_.end() ? nullptr : &found->second;
}

std::string ZipArchive::unpacked(const Entry& entry) const {
  ByteReader bytes = record(source_, entry.header, kFileHeader, "header of a file");
  const auto fail = [&](const std::string& reason) { bytes.fail(in_quotes(entry.name) + " " + reason); };
  if ((entry.flags & kEncrypted) != 0) fail("is encrypted");
  if (entry.method != kStored && entry.method != kDeflated)
    fail("is packed by method " + std::to_string(entry.method) + ", which is not read; deflate is");
  bytes.take(22);
  const auto name = bytes.read<std::uint16_t>(), extra = bytes.read<std::uint16_t>();
  bytes.take(std::size_t{name} + extra);
  if (entry.packed > bytes.left()) fail("ends too early; the file is truncated");
  const std::size_t begin = bytes.position(), end = begin + static_cast<std::size_t>(entry.packed);
  std::string content = entry.method == kStored ? std::string(source_.bytes.substr(begin, end - begin))
                                                : inflated(source_, begin, end);
  const auto* const data = reinterpret_cast<const Bytef*>(content.data());
  if (content.size() != entry.size || crc32_z(0, data, content.size()) != entry.checksum)
    fail("is damaged: its size or checksum is another");
  return content;
}

}  // namespace holdfast::io
