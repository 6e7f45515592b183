// What the sources use and emscripten 3.1.6's libc++ 13 lacks; included before every source of that build
// alone.
#pragma once

#ifdef __cplusplus

#include <version>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 14000

#include <bit>
#include <charconv>
#include <type_traits>

#include "shortest.h"

namespace std {

#ifndef __cpp_lib_bit_cast
template <class To, class From>
requires(sizeof(To) == sizeof(From) && is_trivially_copyable_v<To> && is_trivially_copyable_v<From>)
    [[nodiscard]] constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}
#endif

inline to_chars_result to_chars(char* first, char* last, double value) {
  return holdfast::web::shortest(first, last, value);
}
inline to_chars_result to_chars(char* first, char* last, double value, chars_format format) {
  return holdfast::web::shortest(first, last, value, format);
}
inline to_chars_result to_chars(char* first, char* last, double value, chars_format format, int digits) {
  return holdfast::web::rounded(first, last, value, format, digits);
}

}  // namespace std
#endif
#endif
