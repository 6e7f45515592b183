// What a call says that a limit or its caller ended.
#pragma once

#include <string>

#include "holdfast/limits.h"

namespace holdfast {

/// Whether that is how a call ended.
[[nodiscard]] constexpr bool is_interruption(Outcome outcome) {
  return outcome == Outcome::time_limit || outcome == Outcome::memory_limit || outcome == Outcome::cancelled;
}

/// Names the limit as it was given.
[[nodiscard]] std::string limit_message(Outcome outcome, const Limits& limits);

}  // namespace holdfast
