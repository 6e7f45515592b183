// What zlib unpacks: files compressed by gzip, and the deflated files of an archive.
#pragma once

#include <string>
#include <string_view>

#include "io/mesh_data.h"

namespace holdfast::io {

/// Whether bytes begin as gzip's do (RFC 1952), and as no mesh does.
[[nodiscard]] inline bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1F\x8B\x08"); }

struct Unpacked {
  std::string bytes;
  /// How many bytes stand behind the last member, if they are not zeros, which pad tapes.
  std::size_t behind = 0;
};

/// What is in a gzip file. Throws FileError with the byte for one that is damaged, or packed more tightly
/// than meshes are.
[[nodiscard]] Unpacked gunzipped(const Source& source);

/// What the bytes of a file from `begin` to `end` unpack to by deflate (RFC 1951). Throws likewise.
[[nodiscard]] std::string inflated(const Source& source, std::size_t begin, std::size_t end);

}  // namespace holdfast::io
