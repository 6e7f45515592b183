// The characters with a special meaning in XML and HTML, and their entities.
#pragma once

#include <string_view>

namespace holdfast {

/// The entity of a character; empty if the character may stand for itself between double quotes.
[[nodiscard]] constexpr std::string_view entity_of(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    default:
      return {};
  }
}

}  // namespace holdfast
