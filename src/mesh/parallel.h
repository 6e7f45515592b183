// Work shared among threads, for stages whose result does not depend on their number.
#pragma once

#include <cstddef>
#include <functional>

namespace holdfast {

/// Threads that `requested` stands for: itself, or for 0 as many as the machine runs at once.
[[nodiscard]] unsigned thread_count(unsigned requested);

/// Calls task(0) to task(count - 1), each once, on up to `threads` threads, and returns when all are done.
/// The calling thread takes part and runs task 0, so that a monitor may be polled there. Threads that the
/// system refuses are done without. If tasks throw, the exception of the first of them is thrown on.
void parallel(unsigned threads, std::size_t count, const std::function<void(std::size_t)>& task);

/// Cuts 0..size-1 into at most `threads` even ranges of some length and calls body(first, last) for each.
void parallel_ranges(unsigned threads, std::size_t size,
                     const std::function<void(std::size_t first, std::size_t last)>& body);

}  // namespace holdfast
