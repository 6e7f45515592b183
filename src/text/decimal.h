// Numbers in messages. They always have a decimal point: printf follows the locale of the host program, which
// may write 1,5 for one and a half.
#pragma once

#include <string>

namespace holdfast {

/// The shortest text that distinguishes `value` from all other doubles.
[[nodiscard]] std::string decimal(double value);
/// `value` rounded to at most `digits` significant digits (1 to 17), like printf's %g in the C locale.
[[nodiscard]] std::string decimal(double value, int digits);

}  // namespace holdfast
