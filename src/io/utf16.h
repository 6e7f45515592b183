// Text in UTF-16, as some programs on Windows write it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace holdfast::io {

/// The bytes as UTF-8 if they are text in UTF-16: a byte order mark, then whole characters, none of which is
/// 0, as bytes of numbers would be. Otherwise nothing.
[[nodiscard]] std::optional<std::string> from_utf16(std::string_view bytes);

}  // namespace holdfast::io
