#include "view/text.h"

#include <cmath>
#include <cstdint>

#include "text/decimal.h"
#include "text/markup.h"

namespace holdfast::view {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

/// Bytes of the character that `text` begins with: 0 for what is no UTF-8 (RFC 3629, section 4).
std::size_t length_of_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xC2 && lead < 0xE0   ? 2
                             : lead >= 0xE0 && lead < 0xF0 ? 3
                             : lead >= 0xF0 && lead < 0xF5 ? 4
                                                           : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  if (lead == 0xE0 && byte(1) < 0xA0) return 0;   // overlong
  if (lead == 0xED && byte(1) >= 0xA0) return 0;  // surrogates
  if (lead == 0xF0 && byte(1) < 0x90) return 0;   // overlong
  if (lead == 0xF4 && byte(1) >= 0x90) return 0;  // beyond U+10FFFF
  return length;
}

}  // namespace

std::string clean(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = length_of_character(text);
    const bool is_control = length == 1 && static_cast<std::uint8_t>(text[0]) < 0x20 && text[0] != '\n';
    result += length == 0 || is_control || text[0] == '\x7F' ? kReplacement : text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return result;
}

std::string html(std::string_view text) {
  std::string result;
  for (const char c : clean(text)) {
    const std::string_view entity = c == '\'' ? "&#39;" : entity_of(c);
    if (!entity.empty())
      result += entity;
    else
      result += c;
  }
  return result;
}

std::string json(std::string_view text) {
  std::string result = "\"";
  for (const char c : clean(text)) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n')
      result += "\\n";
    else
      result += c;
  }
  return result += '"';
}

std::string json(double value) { return std::isfinite(value) ? decimal(value) : "null"; }

}  // namespace holdfast::view
