#include "mesh/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace holdfast {
namespace {

constexpr std::size_t kLeastRange = 4096;  // shorter ranges are not worth a thread

}  // namespace

unsigned thread_count(unsigned requested) {
  return requested != 0 ? requested : std::max(1u, std::thread::hardware_concurrency());
}

void parallel(unsigned threads, std::size_t count, const std::function<void(std::size_t)>& task) {
  if (count == 0) return;
  std::vector<std::exception_ptr> errors(count);
  std::atomic<std::size_t> next{1};
  const auto attempt = [&](std::size_t k) {
    try {
      task(k);
    } catch (...) {
      errors[k] = std::current_exception();
    }
  };
  const auto work = [&] {
    for (std::size_t k = next++; k < count; k = next++) attempt(k);
  };
  {
    std::vector<std::jthread> others;
    const std::size_t wanted = std::min<std::size_t>(threads, count) - (threads > 0 ? 1 : 0);
    others.reserve(wanted);
    try {
      while (others.size() < wanted) others.emplace_back(work);
    } catch (const std::system_error&) {
      // Those that there are do the work.
    }
    attempt(0);
    work();
  }
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

void parallel_ranges(unsigned threads, std::size_t size,
                     const std::function<void(std::size_t first, std::size_t last)>& body) {
  const std::size_t count = std::clamp<std::size_t>(size / kLeastRange, 1, std::max(1u, threads));
  parallel(threads, count, [&](std::size_t k) { body(size * k / count, size * (k + 1) / count); });
}

}  // namespace holdfast
