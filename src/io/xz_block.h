// Unpacks .xz streams, in which VTK packs blocks, by liblzma.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace holdfast::io {

/// Whether this build has liblzma.
[[nodiscard]] bool has_xz();

/// A byte stands for at most this many bytes: a repeated match of 273 bytes takes 14 bits of the range coder,
/// each of which costs at least a forty-fifth of a bit.
inline constexpr std::uint64_t kBestRatioOfXz = 8192;

/// Appends the content of a stream and returns true if it has exactly `size` bytes. Otherwise, and without
/// liblzma, returns false, with a part of it appended.
[[nodiscard]] bool append_xz(std::string& bytes, std::string_view stream, std::size_t size);

}  // namespace holdfast::io
