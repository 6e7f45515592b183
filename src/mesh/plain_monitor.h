// The monitor of a call without stages: diagnose, check, delaunay, reading and writing.
#pragma once

#include <functional>

#include "holdfast/limits.h"
#include "mesh/monitor.h"

namespace holdfast {

class PlainMonitor {
 public:
  /// `limits` must outlive it. Throws std::invalid_argument as Monitor does, and for a negative time limit.
  PlainMonitor(const Limits& limits, ProgressFunction progress);
  PlainMonitor(const PlainMonitor&) = delete;
  PlainMonitor& operator=(const PlainMonitor&) = delete;

  /// Throws Interrupted where a limit is reached or the caller cancels. Cheap enough for inner loops.
  void poll(double fraction) { monitor_.poll(Stage::validate, fraction); }
  /// As poll, but checks at once and calls the caller's function.
  void tell(double fraction) {
    monitor_.begin_part({fraction, 1});
    monitor_.enter(Stage::validate);
  }
  /// As poll, where a loop does not know how much is done.
  void poll_again() { monitor_.poll_again(); }
  [[nodiscard]] Monitor& monitor() { return monitor_; }

 private:
  const ProgressFunction progress_;
  const std::function<bool(const Progress&)> tell_;  // empty where `progress_` is
  Monitor monitor_;
};

}  // namespace holdfast
