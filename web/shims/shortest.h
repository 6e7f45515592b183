// std::to_chars for doubles by the conversions of the C library, which round correctly in musl and glibc.
#pragma once

#include <cfloat>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace holdfast::web {

inline std::to_chars_result copy(char* first, char* last, const char* text) {
  const std::size_t size = std::strlen(text);
  if (size > static_cast<std::size_t>(last - first)) return {last, std::errc::value_too_large};
  std::memcpy(first, text, size);
  return {first + size, std::errc()};
}

inline const char* not_finite(double value) {
  if (std::isnan(value)) return std::signbit(value) ? "-nan" : "nan";
  return value < 0 ? "-inf" : "inf";
}

/// The fewest digits that read back as the same double, as "%e" has them. Up to 15 digits survive a normal
/// double, so fewer are 15 without the zeros behind. The gap below a power of two is half of that above, so
/// there the nearest number of 16 digits may miss while the next one does not.
inline void shortest_scientific(char (&text)[64], double value) {
  for (int digits = std::fabs(value) < DBL_MIN ? 1 : 15; digits <= 17; ++digits) {
    std::snprintf(text, sizeof text, "%.*e", digits - 1, value);
    if (std::strtod(text, nullptr) == value) break;
    if (digits != 16) continue;
    char* last = std::strchr(text, 'e') - 1;
    if (*last == '9') continue;
    ++*last;
    if (std::strtod(text, nullptr) == value) break;
  }
  if (std::strchr(text, '.') == nullptr) return;
  char* const exponent = std::strchr(text, 'e');
  char* end = exponent;
  while (end[-1] == '0' && end[-2] != '.') --end;
  if (end[-1] == '0') end -= 2;
  std::memmove(end, exponent, std::strlen(exponent) + 1);
}

/// In the given notation, or without one in the shorter of the two ([charconv.to.chars]); of equal ones the
/// fixed.
inline std::to_chars_result shortest(char* first, char* last, double value,
                                     std::chars_format format = std::chars_format()) {
  if (!std::isfinite(value)) return copy(first, last, not_finite(value));
  char scientific[64], fixed[512];
  shortest_scientific(scientific, value);
  if (format == std::chars_format::scientific) return copy(first, last, scientific);
  const char* const exponent = std::strchr(scientific, 'e');
  const char* const point = std::strchr(scientific, '.');
  const int behind =
      (point != nullptr ? static_cast<int>(exponent - point) - 1 : 0) - std::atoi(exponent + 1);
  std::snprintf(fixed, sizeof fixed, "%.*f", behind > 0 ? behind : 0, value);
  if (format == std::chars_format::fixed || std::strlen(fixed) <= std::strlen(scientific))
    return copy(first, last, fixed);
  return copy(first, last, scientific);
}

inline std::to_chars_result rounded(char* first, char* last, double value, std::chars_format format,
                                    int digits) {
  if (!std::isfinite(value)) return copy(first, last, not_finite(value));
  char text[512];
  const char* const how = format == std::chars_format::scientific ? "%.*e"
                          : format == std::chars_format::fixed    ? "%.*f"
                                                                  : "%.*g";
  std::snprintf(text, sizeof text, how, digits, value);
  return copy(first, last, text);
}

}  // namespace holdfast::web
