// Decodes the arrays of VTK's XML files: base64, size headers, and blocks packed by zlib, LZ4 or LZMA.
#pragma once

#include <bit>
#include <cstdint>
#include <string>

#include "io/mesh_data.h"

namespace holdfast::io {

enum class VtuCompressor : std::uint8_t { none, zlib, lz4, lzma };

/// How a file encodes all of its arrays.
struct VtuEncoding {
  std::endian order = std::endian::little;
  bool wide_header = false;  ///< sizes have 64 bits instead of 32
  VtuCompressor compressor = VtuCompressor::none;
};

/// The size in bytes that the header at `position` announces for its array, before the array is unpacked.
/// Throws FileError with the byte.
[[nodiscard]] std::uint64_t announced_size(const Source& source, const VtuEncoding& encoding, bool base64,
                                           std::size_t position);

/// The bytes of the array whose header starts at `position`. Throws FileError with the byte. Never allocates
/// more than the available data can unpack to.
[[nodiscard]] std::string decode_vtu_array(const Source& source, const VtuEncoding& encoding, bool base64,
                                           std::size_t position);

}  // namespace holdfast::io
