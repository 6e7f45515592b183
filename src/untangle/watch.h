// The present step of untangling, polled by its loops for progress and limits.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "holdfast/untangle.h"
#include "mesh/monitor.h"

namespace holdfast {

class Watch {
 public:
  /// `monitor` does not report a stage: its callback asks here.
  explicit Watch(Monitor& monitor) : monitor_(monitor) {}

  void enter(UntangleStep step) {
    clock();
    step_ = step;
    monitor_.enter(Stage::validate);
  }
  /// Cheap; throws Interrupted where a limit is reached or the caller cancels.
  void poll() { monitor_.poll(Stage::validate, 0); }
  /// The same for loops whose turns take long.
  void poll_slow_loop() { monitor_.enter(Stage::validate); }
  /// Ends the last step's time.
  void finish() { clock(); }

  [[nodiscard]] UntangleStep step() const { return step_; }
  [[nodiscard]] const std::map<std::string, double>& seconds() const { return seconds_; }

 private:
  void clock() {
    const auto now = std::chrono::steady_clock::now();
    seconds_[name(step_)] += std::chrono::duration<double>(now - since_).count();
    since_ = now;
  }

  Monitor& monitor_;
  UntangleStep step_ = UntangleStep::validate;
  std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
  std::map<std::string, double> seconds_;
};

}  // namespace holdfast
