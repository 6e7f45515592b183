// UTF-8 by RFC 3629.
#pragma once

#include <cstdint>
#include <string>

namespace holdfast {

/// Appends the bytes of a character; `code` is below 0x110000 and no surrogate.
inline void append_utf8(std::string& text, std::uint32_t code) {
  const int behind = code < 0x80 ? 0 : code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
  constexpr std::uint32_t kLead[] = {0, 0xC0, 0xE0, 0xF0};
  text += static_cast<char>(kLead[behind] | code >> (6 * behind));
  for (int i = behind - 1; i >= 0; --i) text += static_cast<char>(0x80 | (code >> (6 * i) & 0x3F));
}

}  // namespace holdfast
