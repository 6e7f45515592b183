// Check: called by long loops, so that the caller can watch and stop an examination.
#pragma once

#include <functional>

namespace holdfast::checking {

class Pulse {
 public:
  explicit Pulse(const std::function<void(double)>& step) : step_(step) {}
  /// Costs next to nothing; may throw.
  void operator()() {
    if (++beats_ % kBeatsAStep == 0) step_(share_);
  }
  /// Reports the finished share of the whole work.
  void reach(double share) {
    share_ = share;
    step_(share_);
  }

 private:
  static constexpr unsigned kBeatsAStep = 512;  // less than a millisecond of the slowest loop
  const std::function<void(double)>& step_;
  unsigned beats_ = 0;
  double share_ = 0;
};

}  // namespace holdfast::checking
