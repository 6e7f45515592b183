#include "mesh/monitor.h"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace holdfast {

using namespace std::chrono_literals;

Monitor::Monitor(const Options& options)
    : options_(options),
      start_(std::chrono::steady_clock::now()),
      last_told_(start_),
      last_measured_(start_) {}

void Monitor::look(Stage stage, double fraction, bool tell) {
  stage_ = stage;
  const auto now = std::chrono::steady_clock::now();
  if (options_.time_limit > 0 && std::chrono::duration<double>(now - start_).count() > options_.time_limit)
    throw Interrupted(Outcome::time_limit);
  if (options_.memory_limit > 0 && (tell || now - last_measured_ > 20ms)) {
    last_measured_ = now;
    if (resident_memory_bytes() > options_.memory_limit) throw Interrupted(Outcome::memory_limit);
  }
  if (options_.progress && (tell || now - last_told_ > 50ms)) {
    last_told_ = now;
    if (!options_.progress({stage, fraction})) throw Interrupted(Outcome::cancelled);
  }
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
