// Numbers read from text, independent of the locale of the host program.
#pragma once

#include <charconv>

namespace holdfast {

/// std::from_chars for doubles, which libc++ lacks before version 20: the double nearest to the longest
/// number at the beginning of the text. A leading + is not accepted.
std::from_chars_result parse_double(const char* first, const char* last, double& value);

/// The same for numbers as files spell them: a leading + is accepted, and a number too small for a double
/// becomes a zero of its sign. `result_out_of_range` means that the number is too large.
std::from_chars_result parse_real(const char* first, const char* last, double& value);

}  // namespace holdfast
