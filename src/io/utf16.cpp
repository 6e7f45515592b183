// UTF-16 by RFC 2781.
#include "io/utf16.h"

#include <cstdint>

#include "text/utf8.h"

namespace holdfast::io {

std::optional<std::string> from_utf16(std::string_view bytes) {
  const bool little = bytes.starts_with("\xFF\xFE"), big = bytes.starts_with("\xFE\xFF");
  if ((!little && !big) || bytes.size() % 2 != 0) return std::nullopt;
  const auto unit = [&](std::size_t i) {
    const auto first = static_cast<unsigned char>(bytes[i]),
               second = static_cast<unsigned char>(bytes[i + 1]);
    return static_cast<std::uint32_t>(little ? first | (second << 8U) : second | (first << 8U));
  };
  const auto is_first = [](std::uint32_t c) { return c >= 0xD800U && c < 0xDC00U; };
  const auto is_second = [](std::uint32_t c) { return c >= 0xDC00U && c < 0xE000U; };
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t i = 2; i < bytes.size(); i += 2) {
    std::uint32_t c = unit(i);
    if (c == 0 || is_second(c)) return std::nullopt;
    if (is_first(c)) {
      if (i + 2 >= bytes.size() || !is_second(unit(i + 2))) return std::nullopt;
      c = 0x10000U + ((c - 0xD800U) << 10U) + (unit(i + 2) - 0xDC00U);
      i += 2;
    }
    append_utf8(text, c);
  }
  return text;
}

}  // namespace holdfast::io
