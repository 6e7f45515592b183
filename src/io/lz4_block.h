// Unpacks LZ4's blocks (https://github.com/lz4/lz4/blob/dev/doc/lz4_Block_format.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace holdfast::io {

/// A byte of a block stands for at most this many bytes: by one more byte in the length of a match.
inline constexpr std::uint64_t kBestRatioOfLz4 = 255;

/// Appends the content of a block and returns true if it has exactly `size` bytes; otherwise returns false,
/// with a part of it appended.
[[nodiscard]] bool append_lz4_block(std::string& bytes, std::string_view block, std::size_t size);

}  // namespace holdfast::io
