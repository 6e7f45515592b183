// Progress, limits and cancellation: what a long stage polls.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <thread>

#include "holdfast/holdfast.h"
#include "mesh/parallel.h"

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

/// What the monitors of tasks that run at the same time share.
struct MonitoredTasks {
  const std::thread::id caller = std::this_thread::get_id();
  std::size_t count = 1;
  std::array<double, 2> part{0, 1};  ///< of the stage's work
  std::atomic<std::size_t> done = 0;
  std::atomic<bool> stop = false;
  std::atomic<Outcome> why = Outcome::done;  ///< set before `stop`
};

/// One a call of the API. `poll` is cheap enough for inner loops: it looks at the clock now and then.
class Monitor {
 public:
  explicit Monitor(const Options& options);
  /// For one of several tasks: it sees to the limits on any thread, but calls back on the caller's alone.
  Monitor(Monitor& whole, MonitoredTasks& tasks);
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
  void look_at_limits(bool at_once);
  void call_back(Stage stage, double fraction, bool at_once);
  void look_as_task(Stage stage, double fraction);

  const Options& options_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_told_;
  std::chrono::steady_clock::time_point last_measured_;
  unsigned calls_ = 0;
  Stage stage_ = Stage::validate;
  Monitor* whole_ = nullptr;  // of a task's
  MonitoredTasks* tasks_ = nullptr;
};

/// mesh/parallel.h's `parallel` with a monitor for each task. Where one is interrupted, all end. To the
/// caller they are the part of the stage's work between two fractions.
void parallel_monitored(const Threads& threads, std::size_t count, Monitor& monitor,
                        std::array<double, 2> part, const std::function<void(std::size_t, Monitor&)>& task);

/// Resident memory of the process now and at its peak, in bytes (0 where the system does not tell).
[[nodiscard]] std::uint64_t resident_memory_bytes();
[[nodiscard]] std::uint64_t peak_memory_bytes();

}  // namespace holdfast
