#include "mesh/monitor.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "mesh/memory.h"
#include "mesh/parallel.h"

namespace holdfast {

namespace {

// Between two calls of the caller's function, and between two readings of the memory in use. On a small mesh
// stages take less than a reading.
constexpr std::chrono::milliseconds kInterval{20}, kLeastInterval{2};

// Ends all tasks when one of them throws. Keeps the first exception, because others may only follow from it.
class FirstFailure {
 public:
  explicit FirstFailure(MonitoredTasks& tasks) : tasks_(tasks) {}

  template <typename Body>
  void guard(const Body& body) {
    try {
      body();
    } catch (const Interrupted& interrupted) {
      end_all(interrupted.outcome());
      throw;
    } catch (...) {
      end_all(Outcome::cancelled);
      throw;
    }
  }

  void rethrow() const {
    if (cause_) std::rethrow_exception(cause_);
  }

 private:
  void end_all(Outcome why) {
    std::call_once(first_, [&] { cause_ = std::current_exception(); });
    tasks_.why = why;
    tasks_.stop = true;
  }

  MonitoredTasks& tasks_;
  std::once_flag first_;
  std::exception_ptr cause_;
};

}  // namespace

Monitor::Monitor(const Limits& limits, const std::function<bool(const Progress&)>& progress)
    : limits_(limits),
      progress_(progress),
      start_(limits.started.value_or(std::chrono::steady_clock::now())),
      last_told_(start_),
      last_looked_(start_) {
  if (limits.memory_limit > 0 && !resident_memory_bytes())
    throw std::invalid_argument(
        "a memory limit cannot be kept here: the system does not tell how much memory is in use");
}

Monitor::Monitor(Monitor& whole, MonitoredTasks& tasks)
    : limits_(whole.limits_),
      progress_(whole.progress_),
      start_(whole.start_),
      last_told_(start_),
      last_measured_(start_),
      last_looked_(start_),
      stage_(tasks.stage),
      whole_(&whole),
      tasks_(&tasks) {}

void Monitor::look(Stage stage, double fraction, bool tell) {
  calls_ = 0;
  stage_ = stage;
  fraction_ = fraction;
  const auto now = std::chrono::steady_clock::now();
  choose_pace(now);
  if (tasks_ != nullptr) return look_as_task(stage, fraction);
  look_at_limits(now, tell);
  call_back(stage, fraction, tell);
}

// A turn of a loop may take nanoseconds or tens of milliseconds.
void Monitor::choose_pace(std::chrono::steady_clock::time_point now) {
  constexpr std::chrono::microseconds kOften{100}, kSeldom{1000};
  const auto since = now - std::exchange(last_looked_, now);
  if (since > kSeldom) calls_a_look_ = 1;
  if (since < kOften) calls_a_look_ = std::min(2 * calls_a_look_, kMostCallsALook);
}

void Monitor::look_at_limits(std::chrono::steady_clock::time_point now, bool at_once) {
  if (limits_.cancel && limits_.cancel->cancelled()) throw Interrupted(Outcome::cancelled);
  if (limits_.time_limit > 0 && std::chrono::duration<double>(now - start_).count() > limits_.time_limit)
    throw Interrupted(Outcome::time_limit);
  if (limits_.memory_limit > 0 && now - last_measured_ > (at_once ? kLeastInterval : kInterval)) {
    last_measured_ = now;
    if (resident_memory_bytes().value_or(0) > limits_.memory_limit) throw Interrupted(Outcome::memory_limit);
  }
}

void Monitor::call_back(Stage stage, double fraction, bool at_once) {
  const double within = std::clamp(fraction, 0.0, 1.0);
  overall_ = std::max(overall_, part_[0] + within * (part_[1] - part_[0]));
  if (!progress_) return;
  const auto now = std::chrono::steady_clock::now();
  if (!at_once && now - last_told_ < kInterval) return;
  last_told_ = now;
  caller_threw_ = true;
  const bool go_on = progress_({stage, within, overall_});
  caller_threw_ = false;
  if (!go_on) throw Interrupted(Outcome::cancelled);
}

void Monitor::look_as_task(Stage stage, double fraction) {
  if (tasks_->stop) throw Interrupted(tasks_->why);
  try {
    look_at_limits(last_looked_, false);
    if (std::this_thread::get_id() != tasks_->caller) return;
    const auto done = static_cast<double>(tasks_->done);
    const double of_tasks = (done + fraction) / static_cast<double>(tasks_->count);
    whole_->call_back(stage, tasks_->part[0] + of_tasks * (tasks_->part[1] - tasks_->part[0]), false);
  } catch (const Interrupted& interrupted) {
    tasks_->why = interrupted.outcome();
    tasks_->stop = true;
    throw;
  }
}

void parallel_monitored(const Threads& threads, std::size_t count, Monitor& monitor,
                        std::array<double, 2> part, const std::function<void(std::size_t, Monitor&)>& task) {
  MonitoredTasks tasks{.count = count, .part = part, .stage = monitor.stage()};
  FirstFailure failure(tasks);
  const Threads polling = threads.polling([&] { failure.guard([&] { monitor.poll_again(); }); });
  try {
    parallel(polling, count, [&](std::size_t k) {
      Monitor own(monitor, tasks);
      failure.guard([&] { task(k, own); });
      ++tasks.done;
    });
  } catch (...) {
    failure.rethrow();
    throw;
  }
}

}  // namespace holdfast
