// The files in a ZIP archive (PKWARE, .ZIP File Format Specification 6.3), such as 3MF and packed AMF.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "io/mesh_data.h"

namespace holdfast::io {

/// Whether bytes begin with the signature of an archive, with which no mesh begins.
[[nodiscard]] inline bool is_zip(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

class ZipArchive {
 public:
  /// Reads the directory at the archive's end. Throws FileError with the byte if it is damaged.
  explicit ZipArchive(const Source& source);

  /// The files by name in lower case, since the names in a package differ in more than case (ECMA-376, part
  /// 2).
  struct Entry {
    std::string name;          ///< as spelled in the archive
    std::uint64_t header = 0;  ///< offset of the file's own header
    std::uint64_t packed = 0, size = 0;
    std::uint32_t checksum = 0;
    std::uint16_t flags = 0, method = 0;
  };
  [[nodiscard]] const std::map<std::string, Entry>& entries() const { return entries_; }
  /// A name as a key of `entries`: in lower case, without a leading "/".
  [[nodiscard]] static std::string key_of(std::string_view name);
  /// The entry with a name in any case, with or without a leading "/"; null if there is none.
  [[nodiscard]] const Entry* find(std::string_view name) const;
  /// The content of a file. Throws FileError if it is damaged, encrypted, or packed by a method other than
  /// deflate.
  [[nodiscard]] std::string unpacked(const Entry& entry) const;

 private:
  Source source_;
  std::map<std::string, Entry> entries_;
};

}  // namespace holdfast::io
