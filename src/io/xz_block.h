// Unpacks .xz streams, as VTK packs its blocks, by liblzma.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace holdfast::io {

/// Whether this build has liblzma.
[[nodiscard]] bool has_xz();

/// A byte stands for at most so many: a repeated match of 273 bytes takes 14 bits of the range coder, each of
/// which costs a forty-fifth of a bit at least.
inline constexpr std::uint64_t kBestRatioOfXz = 8192;

/// Appends what a stream holds, if that is exactly `size` bytes; else, and without liblzma, returns false,
/// with some bytes appended.
[[nodiscard]] bool append_xz(std::string& bytes, std::string_view stream, std::size_t size);

}  // namespace holdfast::io
