// Unpacks LZ4's blocks (https://github.com/lz4/lz4/blob/dev/doc/lz4_Block_format.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace holdfast::io {

/// A byte of a block stands for at most so many: one more in the length of a match.
inline constexpr std::uint64_t kBestRatioOfLz4 = 255;

/// Appends what a block holds, if that is exactly `size` bytes; else returns false, with some of them
/// appended.
[[nodiscard]] bool append_lz4_block(std::string& bytes, std::string_view block, std::size_t size);

}  // namespace holdfast::io
