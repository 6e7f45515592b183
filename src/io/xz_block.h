// Unpacks .xz streams of LZMA2 (https://tukaani.org/xz/xz-file-format.txt; I. Pavlov's LZMA specification,
// public domain), as VTK packs its blocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace holdfast::io {

/// A byte stands for at most so many: a repeated match of 273 bytes takes 14 bits of the range coder, each of
/// which costs a forty-fifth of a bit at least.
inline constexpr std::uint64_t kBestRatioOfXz = 8192;

/// Appends what a stream holds, if that is exactly `size` bytes; else returns false, with some of them
/// appended. Sums other than CRC32 are not looked at.
[[nodiscard]] bool append_xz(std::string& bytes, std::string_view stream, std::size_t size);

}  // namespace holdfast::io
