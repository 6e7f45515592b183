// The message of a call that a limit or its caller ended.
#pragma once

#include <string>

#include "holdfast/limits.h"

namespace holdfast {

/// Names the limit as it was given.
[[nodiscard]] std::string limit_message(Outcome outcome, const Limits& limits);

}  // namespace holdfast
