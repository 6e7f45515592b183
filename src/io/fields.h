// Lines of fields between separators or in columns, for the readers of solvers' formats.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "io/text_reader.h"
#include "text/parse.h"

namespace holdfast::io {

[[nodiscard]] inline std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

/// The parts between separators, with surrounding blanks removed.
[[nodiscard]] inline std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t end = line.find(separator);
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

/// The words of a line without surrounding blanks.
[[nodiscard]] inline std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (!line.empty()) {
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    words.push_back(line.substr(0, end));
    line = trimmed(line.substr(end));
  }
  return words;
}

/// A field as an integer. Errors name the line of `text` that was read last.
[[nodiscard]] inline std::int64_t integer_of(const TextReader& text, std::string_view field,
                                             std::string_view what) {
  std::int64_t value = 0;
  if (field.starts_with('+')) field.remove_prefix(1);
  const char* const end = field.data() + field.size();
  const auto result = std::from_chars(field.data(), end, value);
  if (field.empty() || result.ec != std::errc() || result.ptr != end)
    text.fail("expected " + std::string(what) + ", found " + in_quotes(field));
  return value;
}

[[nodiscard]] inline int id_of(const TextReader& text, std::string_view field, std::string_view what) {
  const std::int64_t value = integer_of(text, field, what);
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
    text.fail(std::string(what) + " is beyond 32 bits: " + std::to_string(value));
  return static_cast<int>(value);
}

/// A field as a number; Fortran's exponents "1.5D+3" and "1.5+3" are accepted.
[[nodiscard]] inline double real_of(const TextReader& text, std::string_view field, std::string_view what) {
  std::string number(field.starts_with('+') ? field.substr(1) : field);
  for (char& c : number)
    if (c == 'd' || c == 'D') c = 'e';
  const std::size_t sign = number.find_last_of("+-");
  if (sign != std::string::npos && sign > 0 &&
      (number[sign - 1] == '.' || (number[sign - 1] >= '0' && number[sign - 1] <= '9')))
    number.insert(sign, 1, 'e');
  double value = 0;
  const char* const end = number.data() + number.size();
  const auto result = parse_double(number.data(), end, value);
  if (result.ec == std::errc::result_out_of_range && result.ptr == end) {
    // Rounded to zero, or beyond the largest double.
    const std::size_t mark = number.find('e');
    const bool tiny = mark != std::string::npos && number.compare(mark + 1, 1, "-") == 0;
    if (!tiny) text.fail(in_quotes(field) + " is too large for a double");
    return number[0] == '-' ? -0.0 : 0.0;
  }
  if (number.empty() || result.ec != std::errc() || result.ptr != end)
    text.fail("expected " + std::string(what) + ", found " + in_quotes(field));
  if (text.source().finite && !std::isfinite(value)) text.fail(std::string(what) + " is not finite");
  return value;
}

}  // namespace holdfast::io
