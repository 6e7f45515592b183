#include "mesh/memory.h"

#include <sys/resource.h>
#include <unistd.h>
#ifdef __EMSCRIPTEN__
#include <emscripten/heap.h>
#endif

#include <fstream>
#include <string>

namespace holdfast {

#ifdef __EMSCRIPTEN__

// A module's memory grows and never shrinks, so its size now is its peak, too.
std::optional<std::uint64_t> resident_memory_bytes(const char*) { return emscripten_get_heap_size(); }
std::uint64_t peak_memory_bytes() { return emscripten_get_heap_size(); }

#else

// No other source stands in: getrusage knows the peak alone, which on Linux begins with that of the program
// that started this one, so that a limit kept by it would be reached where it is not.
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

#endif

}  // namespace holdfast
