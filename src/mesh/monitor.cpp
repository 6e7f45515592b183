#include "mesh/monitor.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <string>

#include "mesh/parallel.h"

namespace holdfast {

using namespace std::chrono_literals;

Monitor::Monitor(const Options& options)
    : options_(options),
      start_(std::chrono::steady_clock::now()),
      last_told_(start_),
      last_measured_(start_) {}

Monitor::Monitor(Monitor& whole, MonitoredTasks& tasks)
    : options_(whole.options_),
      start_(whole.start_),
      last_told_(start_),
      last_measured_(start_),
      stage_(whole.stage_),
      whole_(&whole),
      tasks_(&tasks) {}

void Monitor::look(Stage stage, double fraction, bool tell) {
  stage_ = stage;
  if (tasks_ != nullptr) return look_as_task(stage, fraction);
  look_at_limits(tell);
  call_back(stage, fraction, tell);
}

void Monitor::look_at_limits(bool at_once) {
  const auto now = std::chrono::steady_clock::now();
  if (options_.time_limit > 0 && std::chrono::duration<double>(now - start_).count() > options_.time_limit)
    throw Interrupted(Outcome::time_limit);
  if (options_.memory_limit > 0 && (at_once || now - last_measured_ > 20ms)) {
    last_measured_ = now;
    if (resident_memory_bytes() > options_.memory_limit) throw Interrupted(Outcome::memory_limit);
  }
}

void Monitor::call_back(Stage stage, double fraction, bool at_once) {
  if (!options_.progress) return;
  const auto now = std::chrono::steady_clock::now();
  if (!at_once && now - last_told_ <= 50ms) return;
  last_told_ = now;
  if (!options_.progress({stage, fraction})) throw Interrupted(Outcome::cancelled);
}

void Monitor::look_as_task(Stage stage, double fraction) {
  if (tasks_->stop) throw Interrupted(tasks_->why);
  try {
    look_at_limits(false);
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
  MonitoredTasks tasks{.count = count, .part = part};
  parallel(threads, count, [&](std::size_t k) {
    Monitor own(monitor, tasks);
    task(k, own);
    ++tasks.done;
  });
}

std::uint64_t resident_memory_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::uint64_t total = 0;
  std::uint64_t resident = 0;
  statm >> total >> resident;
  return statm ? resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) : 0;
}

std::uint64_t peak_memory_bytes() {
  // Linux: getrusage would also count the program that started this one.
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::uint64_t kib = 0;
    if (word == "VmHWM:" && status >> kib) return kib * 1024;
  }
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

}  // namespace holdfast
