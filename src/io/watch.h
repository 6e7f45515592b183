// What bounds the reading or writing of a file: asked by loops over what may be many.
#pragma once

#include "mesh/plain_monitor.h"

namespace holdfast::io {

class Watch {
 public:
  Watch(const Limits& limits, ProgressFunction progress) : monitor_(limits, std::move(progress)) {
    monitor_.tell(0);
  }

  /// For a loop that turns in nanoseconds. Throws Interrupted where a limit is reached or the caller cancels.
  void beat() {
    if (++beats_ % kBeatsAStep == 0) monitor_.poll(share_);
  }
  /// For a loop that turns in a millisecond or more.
  void step() { monitor_.poll(share_); }
  void step(double share) { monitor_.poll(share_ = share); }
  void finish() { monitor_.tell(1); }
  /// Files that were written have their names by now: it is too late for limits.
  void finish_written() {
    try {
      finish();
    } catch (const Interrupted&) {
    }
  }

 private:
  static constexpr unsigned kBeatsAStep = 512;
  PlainMonitor monitor_;
  unsigned beats_ = 0;
  double share_ = 0;
};

inline void beat(Watch* watch) {
  if (watch != nullptr) watch->beat();
}
inline void step(Watch* watch) {
  if (watch != nullptr) watch->step();
}

}  // namespace holdfast::io
