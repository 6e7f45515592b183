#include "text/parse.h"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <version>

#if !defined(__cpp_lib_to_chars)
#include <locale.h>
#include <stdlib.h>
#if defined(__APPLE__) || defined(__FreeBSD__)
#include <xlocale.h>
#endif

#include <cmath>
#include <string>
#endif

namespace holdfast {

#if defined(__cpp_lib_to_chars)

std::from_chars_result parse_double(const char* first, const char* last, double& value) {
  return std::from_chars(first, last, value);
}

#else

namespace {

const char* past_digits(const char* at, const char* last) {
  while (at != last && *at >= '0' && *at <= '9') ++at;
  return at;
}

const char* past_word(const char* at, const char* last, const char* lower) {
  for (; *lower != '\0'; ++at, ++lower)
    if (at == last || (*at | 0x20) != *lower) return nullptr;
  return at;
}

// The end of the number that the text begins with, or null.
const char* past_number(const char* first, const char* last) {
  const char* const begin = first != last && *first == '-' ? first + 1 : first;
  for (const char* word : {"infinity", "inf", "nan"})
    if (const char* const end = past_word(begin, last, word)) return end;
  const char* at = past_digits(begin, last);
  auto digits = at - begin;
  if (at != last && *at == '.') {
    const char* const fraction = at + 1;
    at = past_digits(fraction, last);
    digits += at - fraction;
  }
  if (digits == 0) return nullptr;
  if (at != last && (*at | 0x20) == 'e') {
    const char* exponent = at + 1;
    if (exponent != last && (*exponent == '-' || *exponent == '+')) ++exponent;
    if (const char* const end = past_digits(exponent, last); end != exponent) at = end;
  }
  return at;
}

locale_t plain_locale() {
  static const locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
  return plain;
}

}  // namespace

std::from_chars_result parse_double(const char* first, const char* last, double& value) {
  const char* const end = past_number(first, last);
  if (end == nullptr) return {first, std::errc::invalid_argument};
  const std::string number(first, end);
  const double nearest = strtod_l(number.c_str(), nullptr, plain_locale());
  const bool is_finite_number = number.find_first_of("iInN") == std::string::npos;
  const bool is_lost =
      nearest == 0 &&
      number.substr(0, number.find_first_of("eE")).find_first_of("123456789") != std::string::npos;
  if (is_finite_number && (std::isinf(nearest) || is_lost)) return {end, std::errc::result_out_of_range};
  value = nearest;
  return {end, std::errc()};
}

#endif

namespace {

/// Whether a number that overflows or underflows is below 1 in absolute value.
bool is_tiny(std::string_view number) {
  const std::size_t mark = number.find_first_of("eE");
  const std::string_view mantissa = number.substr(0, mark);
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  const std::size_t leading = mantissa.find_first_of("123456789");
  if (leading == std::string_view::npos) return true;
  std::int64_t exponent = 0;
  if (mark != std::string_view::npos) {
    std::string_view digits = number.substr(mark + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (result.ec == std::errc::result_out_of_range) return digits.starts_with('-');
  }
  const auto places = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(leading);
  // The bound keeps the sum from overflowing; no file is that long.
  constexpr std::int64_t kBound = std::int64_t{1} << 62;
  return std::clamp(exponent, -kBound, kBound) + places <= 0;
}

}  // namespace

std::from_chars_result parse_real(const char* first, const char* last, double& value) {
  if (last - first > 1 && *first == '+' && first[1] != '-') ++first;
  std::from_chars_result result = parse_double(first, last, value);
  if (result.ec == std::errc::result_out_of_range &&
      is_tiny(std::string_view(first, static_cast<std::size_t>(result.ptr - first)))) {
    value = *first == '-' ? -0.0 : 0.0;
    result.ec = std::errc();
  }
  return result;
}

}  // namespace holdfast
