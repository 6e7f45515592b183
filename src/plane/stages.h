// The stages of a run: the share of work and the time of each.
#pragma once

#include <chrono>
#include <map>
#include <string>

#include "plane/triangles.h"

namespace holdfast::plane {

class Stages {
 public:
  /// `poll` is called with the share of all work that is done; seconds are added under the stages' names.
  Stages(const Poll& poll, std::map<std::string, double>& seconds) : poll_(poll), seconds_(seconds) {}

  /// Runs a stage, whose share of the work lasts from the end of the previous stage to `until`. Calls `work`
  /// with a poll that takes the share of the stage, and returns its result.
  template <typename Work>
  auto run(const char* name, double until, Work&& work) {
    const double from = done_;
    const Poll share = [&](double fraction) { poll_(from + fraction * (until - from)); };
    const Timer timer{seconds_[name]};
    done_ = until;
    return work(share);
  }

  /// Adds the seconds of its lifetime.
  struct Timer {
    double& seconds;
    const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    ~Timer() { seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }
  };

 private:
  const Poll& poll_;
  std::map<std::string, double>& seconds_;
  double done_ = 0;
};

}  // namespace holdfast::plane
