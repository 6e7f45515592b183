// The files in a ZIP archive (PKWARE, .ZIP File Format Specification 6.3), as 3MF and packed AMF are.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "io/mesh_data.h"

namespace holdfast::io {

/// Whether bytes begin as an archive does, and as no mesh does.
[[nodiscard]] inline bool is_zip(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

class ZipArchive {
 public:
  /// Reads the directory at the archive's end. Throws FileError with the byte for one that is damaged.
  explicit ZipArchive(const Source& source);

  /// The files' names in lower case, since those of a package differ in more than case (ECMA-376, part 2).
  struct Entry {
    std::string name;          ///< as the archive spells it
    std::uint64_t header = 0;  ///< offset of the file's own header
    std::uint64_t packed = 0, size = 0;
    std::uint32_t checksum = 0;
    std::uint16_t flags = 0, method = 0;
  };
  [[nodiscard]] const std::map<std::string, Entry>& entries() const { return entries_; }
  /// A name as the keys of `entries` are: in lower case, without "/" before it.
  [[nodiscard]] static std::string key_of(std::string_view name);
  /// The entry of a name in any case, with or without "/" before it; null without one.
  [[nodiscard]] const Entry* find(std::string_view name) const;
  /// The bytes of a file. Throws FileError where they are damaged, encrypted, or packed otherwise than by
  /// deflate.
  [[nodiscard]] std::string unpacked(const Entry& entry) const;

 private:
  Source source_;
  std::map<std::string, Entry> entries_;
};

}  // namespace holdfast::io
