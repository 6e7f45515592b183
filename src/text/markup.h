// Characters that mean something in XML and HTML, and how these spell them.
#pragma once

#include <string_view>

namespace holdfast {

/// The entity of a character, or nothing where it stands for itself, as it may between double quotes.
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
