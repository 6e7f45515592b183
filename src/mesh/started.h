// A common start time for a call and the calls that it makes.
#pragma once

#include <chrono>

#include "holdfast/limits.h"

namespace holdfast {

/// The same limits, with their time running from now on unless it is running already.
[[nodiscard]] inline Limits started(Limits limits) {
  if (!limits.started) limits.started = std::chrono::steady_clock::now();
  return limits;
}

}  // namespace holdfast
