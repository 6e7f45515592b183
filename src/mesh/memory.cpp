#include "mesh/memory.h"

#include <sys/resource.h>
#include <unistd.h>
#ifdef __EMSCRIPTEN__
#include <emscripten/heap.h>
#endif

#include <algorithm>
#include <fstream>
#include <string>

namespace holdfast {

#ifdef __EMSCRIPTEN__

// The memory of a module never shrinks, so its present size is also its peak.
std::optional<std::uint64_t> resident_memory_bytes(const char*) { return emscripten_get_heap_size(); }
std::uint64_t peak_memory_bytes() { return emscripten_get_heap_size(); }
std::optional<std::uint64_t> machine_memory_bytes(const char*) { return std::nullopt; }

#else

// There is no other source: getrusage knows only the peak. On Linux that peak starts with that of the program
// that started this one, so a limit checked against it would trigger too early.
std::optional<std::uint64_t> resident_memory_bytes(const char* statm) {
  std::ifstream file(statm);
  std::uint64_t total = 0;
  std::uint64_t resident = 0;
  file >> total >> resident;
  if (!file || resident == 0) return std::nullopt;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
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

std::optional<std::uint64_t> machine_memory_bytes(const char* most) {
  const long pages = sysconf(_SC_PHYS_PAGES), bytes = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || bytes <= 0) return std::nullopt;
  const std::uint64_t all = static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(bytes);
  std::uint64_t group = 0;
  if (std::ifstream(most) >> group) return std::min(all, group);  // without a limit the file says "max"
  return all;
}

#endif

}  // namespace holdfast
