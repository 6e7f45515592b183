// Letters of names of files and formats, in ASCII alone, whatever the locale.
#pragma once

#include <algorithm>
#include <string>

namespace holdfast::cli {

[[nodiscard]] inline std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

}  // namespace holdfast::cli
