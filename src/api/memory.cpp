#include "holdfast/memory.h"

#include <sys/resource.h>

#include <optional>

#include "mesh/memory.h"

namespace holdfast {

namespace {

// As by `ulimit -v`. The system then refuses memory, and the call says so.
bool has_limit_of_the_system() {
  rlimit most{};
  return getrlimit(RLIMIT_AS, &most) == 0 && most.rlim_cur != RLIM_INFINITY;
}

}  // namespace

std::uint64_t usual_memory_limit() {
  if (has_limit_of_the_system()) return 0;
  const std::optional<std::uint64_t> all = machine_memory_bytes();
  return all && resident_memory_bytes() ? *all - *all / 20 : 0;
}

}  // namespace holdfast
