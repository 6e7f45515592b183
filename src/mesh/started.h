// The time of calls that make others, which all share it.
#pragma once

#include <chrono>

#include "holdfast/limits.h"

namespace holdfast {

/// The same limits, whose time runs from now on unless it does so already.
[[nodiscard]] inline Limits started(Limits limits) {
  if (!limits.started) limits.started = std::chrono::steady_clock::now();
  return limits;
}

}  // namespace holdfast
