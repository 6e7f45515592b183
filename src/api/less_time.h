// The time limit of optional work, done when a result exists that must still be delivered and written within
// the limit of the call.
#pragma once

#include <algorithm>
#include <chrono>

#include "holdfast/limits.h"

namespace holdfast {

/// Half of the time that is left, expressed as a time limit.
[[nodiscard]] inline double half_of_the_time(const Limits& limits) {
  const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - *limits.started;
  return (gone.count() + limits.time_limit) / 2;
}

/// Shortens the time limit during its lifetime; does nothing if there is none.
class LessTime {
 public:
  LessTime(Limits& limits, double limit) : limits_(limits), whole_(limits.time_limit) {
    if (whole_ > 0) limits.time_limit = std::min(whole_, limit);
  }
  LessTime(const LessTime&) = delete;
  LessTime& operator=(const LessTime&) = delete;
  ~LessTime() { limits_.time_limit = whole_; }

 private:
  Limits& limits_;
  const double whole_;
};

}  // namespace holdfast
