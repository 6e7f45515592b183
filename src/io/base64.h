// The alphabet of base64.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

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

}  // namespace holdfast::io
