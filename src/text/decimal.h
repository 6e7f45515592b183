// Numbers in messages. They always have a decimal point: printf follows the locale of the host program, which
// may write 1,5 for one and a half.
#pragma once

#include <string>

namespace holdfast {

/// The shortest text that distinguishes `value` from all other doubles.
[[nodiscard]] std::string decimal(double value);
/// `value` rounded to at most `digits` significant digits (1 to 17), like printf's %g in the C locale.
[[nodiscard]] std::string decimal(double value, int digits);
/// Whether `value` is a float, or the text of one with any number of digits: .stl and other files of text
/// have such numbers, as 0.333333343 and 0.333333 for a third.
[[nodiscard]] bool is_text_of_float(double value);

}  // namespace holdfast
