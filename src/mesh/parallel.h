// Work shared among threads, for stages whose result does not depend on their number.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <thread>

namespace holdfast {

/// So many threads, the calling one among them. The others start when there is first work for them, and wait
/// for more as long as there is a copy: a new thread for every piece of work would often begin milliseconds
/// late, since the system puts it where the one before it was.
class Threads {
 public:
  /// For 0, as many as the machine runs at once.
  Threads(unsigned requested = 1);  // NOLINT(google-explicit-constructor): a number says all
  [[nodiscard]] unsigned count() const { return count_; }
  /// Some of these.
  [[nodiscard]] Threads at_most(unsigned count) const;
  /// The same, but that the thread that calls `parallel` calls `between`, too: between tasks, and while it
  /// waits for those of others. What it throws ends the work as soon as may be and is thrown on.
  [[nodiscard]] Threads polling(std::function<void()> between) const;
  /// Calls that function, if there is one, on the thread that gave it; for long loops and tasks, and between
  /// calls of `parallel`.
  void poll() const {
    if (between_ && std::this_thread::get_id() == polls_on_) (*between_)();
  }

 private:
  friend void parallel(const Threads& threads, std::size_t count,
                       const std::function<void(std::size_t)>& task);
  friend void parallel_ranges(const Threads& threads, std::size_t size,
                              const std::function<void(std::size_t, std::size_t)>& body);
  class Helpers;

  unsigned count_;
  std::shared_ptr<Helpers> helpers_;  // none for one thread
  std::shared_ptr<const std::function<void()>> between_;
  std::thread::id polls_on_;
};

/// Calls task(0) to task(count - 1), each once, on up to `threads` threads, and returns when all are done.
/// The calling thread takes part and runs task 0, so that a monitor may be polled there. A task may call this
/// again. Threads that the system refuses are done without. If tasks throw, the exception of the first of
/// them is thrown on.
void parallel(const Threads& threads, std::size_t count, const std::function<void(std::size_t)>& task);

/// Cuts 0..size-1 into even ranges of some length and calls body(first, last) for each: at most as many as
/// `threads`, or where these poll, so many that each takes a moment.
void parallel_ranges(const Threads& threads, std::size_t size,
                     const std::function<void(std::size_t first, std::size_t last)>& body);

}  // namespace holdfast
