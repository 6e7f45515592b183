// Progress, limits and cancellation: what a long stage polls.
#pragma once

#include <chrono>
#include <exception>

#include "holdfast/holdfast.h"

namespace holdfast {

/// Thrown out of a stage when a limit is reached or the caller cancels; the API turns it into an outcome.
class Interrupted : public std::exception {
 public:
  explicit Interrupted(Outcome outcome) : outcome_(outcome) {}
  [[nodiscard]] Outcome outcome() const { return outcome_; }
  [[nodiscard]] const char* what() const noexcept override { return "holdfast: interrupted"; }

 private:
  Outcome outcome_;
};

/// One a call of the API. `poll` is cheap enough for inner loops: it looks at the clock now and then.
class Monitor {
 public:
  explicit Monitor(const Options& options);
  /// Throws Interrupted when the time or memory limit is reached or the callback returns false.
  void poll(Stage stage, double fraction) {
    if ((++calls_ & 0xFu) == 0) look(stage, fraction, false);
  }
  /// As poll, but looks at once and always tells the caller: a stage begins.
  void enter(Stage stage) { look(stage, 0, true); }
  /// The stage of the last look.
  [[nodiscard]] Stage stage() const { return stage_; }

 private:
  void look(Stage stage, double fraction, bool tell);

  const Options& options_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_told_;
  std::chrono::steady_clock::time_point last_measured_;
  unsigned calls_ = 0;
  Stage stage_ = Stage::validate;
};

/// Resident memory of the process now and at its peak, in bytes (0 where the system does not tell).
[[nodiscard]] std::uint64_t resident_memory_bytes();
[[nodiscard]] std::uint64_t peak_memory_bytes();

}  // namespace holdfast
