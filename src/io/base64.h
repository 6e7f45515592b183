// base64 (RFC 4648).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/watch.h"

namespace holdfast::io {

/// Values of the characters of base64 (RFC 4648), -1 for others.
constexpr std::array<int, 256> base64_values() {
  std::array<int, 256> values{};
  for (int& value : values) value = -1;
  constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < kAlphabet.size(); ++i)
    values[static_cast<unsigned char>(kAlphabet[i])] = static_cast<int>(i);
  return values;
}

/// The bytes of a text up to its padding, without blanks and line ends; nothing if it has other characters.
[[nodiscard]] inline std::optional<std::string> decoded_base64(std::string_view text, Watch* watch) {
  static constexpr std::array<int, 256> kValues = base64_values();
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  unsigned held = 0;
  for (const char c : text) {
    if (c == '=') break;
    if (c == ' ' || c == '\t' || c == '\r' || c == '\n') continue;
    beat(watch);
    const int value = kValues[static_cast<unsigned char>(c)];
    if (value < 0) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes += static_cast<char>(static_cast<unsigned char>(bits >> held));
  }
  return bytes;
}

}  // namespace holdfast::io
