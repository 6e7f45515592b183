// Numbers on the command line and in plain lists of points.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <version>

namespace holdfast::cli {

/// std::from_chars for doubles, which libc++ only has from version 20 on. The text must end in a zero; the
/// program never sets a locale.
inline std::from_chars_result parse_double(const char* first, const char* last, double& value) {
#if defined(__cpp_lib_to_chars)
  return std::from_chars(first, last, value);
#else
  static_cast<void>(last);
  if (*first == '+' || *first == ' ' || *first == '\t') return {first, std::errc::invalid_argument};
  char* end = nullptr;
  const double nearest = std::strtod(first, &end);
  if (end == first) return {first, std::errc::invalid_argument};
  if (std::isinf(nearest)) return {end, std::errc::result_out_of_range};
  value = nearest;
  return {end, std::errc()};
#endif
}

}  // namespace holdfast::cli
