// Numbers in messages. The program that the library works in may have set a locale, in which printf writes
// 1,5 for one and a half; here it is 1.5 always.
#pragma once

#include <string>

namespace holdfast {

/// In as few digits as tell `value` from all other doubles.
[[nodiscard]] std::string decimal(double value);
/// Rounded to at most `digits` significant digits, between 1 and 17, like printf's %g in the C locale.
[[nodiscard]] std::string decimal(double value, int digits);

}  // namespace holdfast
