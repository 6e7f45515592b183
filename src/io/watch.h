// The limits on reading or writing a file, polled by loops over many items.
#pragma once

#include "mesh/plain_monitor.h"

namespace holdfast::io {

class Watch {
 public:
  Watch(const Limits& limits, ProgressFunction progress) : monitor_(limits, std::move(progress)) {
    monitor_.tell(0);
  }

  /// For a loop with iterations of nanoseconds. Throws Interrupted if a limit is reached or the caller
  /// cancels.
  void beat() {
    if (++beats_ % kBeatsAStep == 0) monitor_.poll(share_);
  }
  /// For a loop with iterations of a millisecond or more.
  void step() { monitor_.poll(share_); }
  void step(double share) { monitor_.poll(share_ = share); }
  void finish() { monitor_.tell(1); }
  /// The files now have their names: it is too late for limits.
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
