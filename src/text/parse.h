// Numbers out of text, whatever locale the program round the library has set.
#pragma once

#include <charconv>

namespace holdfast {

/// std::from_chars for doubles, which libc++ has from version 20 on only: the nearest double of the longest
/// number that the text begins with, without a sign +.
std::from_chars_result parse_double(const char* first, const char* last, double& value);

}  // namespace holdfast
