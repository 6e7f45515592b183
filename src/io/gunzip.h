// Decompresses by zlib: files compressed by gzip, and the deflated files of an archive.
#pragma once

#include <string>
#include <string_view>

#include "io/mesh_data.h"

namespace holdfast::io {

/// Whether bytes begin with gzip's signature (RFC 1952), with which no mesh begins.
[[nodiscard]] inline bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1F\x8B\x08"); }

struct Unpacked {
  std::string bytes;
  /// The number of bytes after the last member, unless they are zeros, which pad tapes.
  std::size_t behind = 0;
};

/// The content of a gzip file. Throws FileError with the byte if the file is damaged or packed more tightly
/// than any mesh.
[[nodiscard]] Unpacked gunzipped(const Source& source);

/// The content of a zlib stream (RFC 1950) or a gzip file. Throws likewise.
[[nodiscard]] std::string unpacked_zlib(const Source& source);

/// The bytes of a file from `begin` to `end`, unpacked by deflate (RFC 1951). Throws likewise.
[[nodiscard]] std::string inflated(const Source& source, std::size_t begin, std::size_t end);

}  // namespace holdfast::io
