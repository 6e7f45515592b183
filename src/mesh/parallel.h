// Work shared among threads, for stages whose result does not depend on their number.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <thread>

namespace holdfast {

/// A number of threads, including the calling one. The others start with the first work, and wait for more
/// while a copy of this object exists. A new thread for each piece of work would often start milliseconds
/// late, because the system puts it on the core of the one before.
class Threads {
 public:
  /// 0: as many as the machine runs at once.
  Threads(unsigned requested = 1);  // NOLINT(google-explicit-constructor): a number says all
  [[nodiscard]] unsigned count() const { return count_; }
  /// Some of these.
  [[nodiscard]] Threads at_most(unsigned count) const;
  /// The same threads, but the thread that calls `parallel` also calls `between`: between tasks, and while it
  /// waits for other threads. An exception from `between` ends the work as soon as possible and is rethrown.
  [[nodiscard]] Threads polling(std::function<void()> between) const;
  /// Calls `between`, if set, on the thread that set it; for long loops and tasks, and between calls of
  /// `parallel`.
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
/// The calling thread takes part and runs task 0, so that a monitor may be polled there. A task may call
/// `parallel` again. If the system refuses threads, the work is done with fewer. If tasks throw, the
/// exception of the first of them is rethrown.
void parallel(const Threads& threads, std::size_t count, const std::function<void(std::size_t)>& task);

/// Cuts 0..size-1 into even ranges of some length and calls body(first, last) for each: at most as many as
/// `threads`, or where these poll, so many that each takes a moment.
void parallel_ranges(const Threads& threads, std::size_t size,
                     const std::function<void(std::size_t first, std::size_t last)>& body);

}  // namespace holdfast
