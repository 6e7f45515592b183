// Numbers out of text, whatever locale the program round the library has set.
#pragma once

#include <charconv>

namespace holdfast {

/// std::from_chars for doubles, which libc++ has from version 20 on only: the nearest double of the longest
/// number that the text begins with, without a sign +.
std::from_chars_result parse_double(const char* first, const char* last, double& value);

/// The same as files spell numbers: a sign + may stand first, and what is too small for a double is a zero of
/// its sign. `result_out_of_range` is left for what is too large.
std::from_chars_result parse_real(const char* first, const char* last, double& value);

}  // namespace holdfast
