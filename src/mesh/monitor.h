// Progress, limits and cancellation, polled by long stages.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include "holdfast/holdfast.h"
#include "mesh/parallel.h"

namespace holdfast {

/// State shared by the monitors of concurrent tasks.
struct MonitoredTasks {
  const std::thread::id caller = std::this_thread::get_id();
  std::size_t count = 1;
  std::array<double, 2> part{0, 1};  ///< of the stage's work
  Stage stage = Stage::validate;     ///< of the whole, which looks again while tasks begin
  std::atomic<std::size_t> done = 0;
  std::atomic<bool> stop = false;
  std::atomic<Outcome> why = Outcome::done;  ///< set before `stop`
};

/// One for each call of the API. `poll` is cheap enough for inner loops: in fast loops it reads the clock
/// only from time to time.
class Monitor {
 public:
  /// Throws std::invalid_argument for a memory limit if the system does not report memory in use.
  explicit Monitor(const Options& options) : Monitor(options, options.progress) {}
  /// Both must outlive the monitor. `progress` may be empty.
  Monitor(const Limits& limits, const std::function<bool(const Progress&)>& progress);
  /// The monitor of one of several tasks: it checks limits on any thread, but calls back only on the caller's
  /// thread.
  Monitor(Monitor& whole, MonitoredTasks& tasks);
  /// Throws Interrupted when the time or memory limit is reached, the token is cancelled or the callback
  /// returns false.
  void poll(Stage stage, double fraction) {
    if (++calls_ >= calls_a_look_) look(stage, fraction, false);
  }
  /// As poll, but checks at once and always reports: a stage begins.
  void enter(Stage stage) { look(stage, 0, true); }
  /// As poll, for loops that take milliseconds a turn and do not know the stage: checks at once, whatever the
  /// pace of the loop before.
  void poll_again() { look(stage_, fraction_, false); }
  /// From now on fractions refer to this part of the whole call.
  void begin_part(std::array<double, 2> part) { part_ = part; }
  /// Marks the present part as done, whatever its last fraction was.
  void end_part() { overall_ = std::max(overall_, part_[1]); }
  /// Part of the whole call that is done.
  [[nodiscard]] double overall() const { return overall_; }
  /// Whether the caller's progress callback threw.
  [[nodiscard]] bool caller_threw() const { return caller_threw_; }
  /// The stage of the last look.
  [[nodiscard]] Stage stage() const { return stage_; }
  /// How much of it was done then.
  [[nodiscard]] double fraction() const { return fraction_; }

 private:
  void look(Stage stage, double fraction, bool tell);
  void look_at_limits(std::chrono::steady_clock::time_point now, bool at_once);
  void call_back(Stage stage, double fraction, bool at_once);
  void look_as_task(Stage stage, double fraction);
  void choose_pace(std::chrono::steady_clock::time_point now);

  const Limits& limits_;
  const std::function<bool(const Progress&)>& progress_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_told_;
  std::chrono::steady_clock::time_point last_measured_;  // at first the beginning of the clock
  std::chrono::steady_clock::time_point last_looked_;
  static constexpr unsigned kMostCallsALook = 16;  // the clock then takes little of the time
  unsigned calls_ = 0, calls_a_look_ = 1;
  std::array<double, 2> part_{0, 1};
  double fraction_ = 0, overall_ = 0;
  bool caller_threw_ = false;
  Stage stage_ = Stage::validate;
  Monitor* whole_ = nullptr;  // of a task's
  MonitoredTasks* tasks_ = nullptr;
};

/// mesh/parallel.h's `parallel` with a monitor for each task. If a task throws, the others end at their next
/// poll, and its exception is rethrown. To the caller, the tasks are the part of the stage's work between two
/// fractions.
void parallel_monitored(const Threads& threads, std::size_t count, Monitor& monitor,
                        std::array<double, 2> part, const std::function<void(std::size_t, Monitor&)>& task);

}  // namespace holdfast
