#include "mesh/parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "numbers/float_environment.h"

namespace holdfast {
namespace {

constexpr std::size_t kLeastRange = 4096;  // shorter ranges are not worth a thread

constexpr std::size_t kPolledRange = 1u << 15;  // a few milliseconds' work

// One call of parallel().
class Job {
 public:
  Job(std::size_t count, const std::function<void(std::size_t)>& task, const std::function<void()>* between)
      : task_(task), between_(between) {
    errors_.resize(count);
  }

  std::size_t wanted = 0;   // threads that may still join
  std::size_t helping = 0;  // threads that have joined

  void run(std::size_t k) {
    try {
      task_(k);
    } catch (...) {
      errors_[k] = std::current_exception();
    }
  }
  void run_what_is_left() {
    for (std::size_t k = next_++; k < errors_.size(); k = next_++) run(k);
  }
  void run_as_caller() {
    run(0);
    poll();
    for (std::size_t k = next_++; k < errors_.size(); k = next_++) {
      run(k);
      poll();
    }
  }
  // Called by the caller alone.
  void poll() {
    if (between_ == nullptr || interruption_) return;
    try {
      (*between_)();
    } catch (...) {
      interruption_ = std::current_exception();
      next_ = errors_.size();
    }
  }
  [[nodiscard]] bool polls() const { return between_ != nullptr && !interruption_; }
  void throw_first_error() const {
    if (interruption_) std::rethrow_exception(interruption_);
    for (const std::exception_ptr& error : errors_)
      if (error) std::rethrow_exception(error);
  }

 private:
  const std::function<void(std::size_t)>& task_;
  const std::function<void()>* between_;
  std::exception_ptr interruption_;
  std::atomic<std::size_t> next_{1};
  std::vector<std::exception_ptr> errors_;
};

}  // namespace

// A job is in the list as long as threads may join it. A thread that calls for help works too, and waits only
// for the threads that did join; so nested jobs end.
class Threads::Helpers {
 public:
  Helpers() = default;
  Helpers(const Helpers&) = delete;
  Helpers& operator=(const Helpers&) = delete;
  ~Helpers() {
    {
      const std::scoped_lock lock(mutex_);
      ending_ = true;
      there_is_work_.notify_all();
    }
    for (std::thread& thread : threads_) thread.join();
  }

  void run(Job& job, std::size_t most) {
    call_for_help(job, most);
    job.run_as_caller();
    std::unique_lock lock(mutex_);
    std::erase(jobs_, &job);
    const auto is_done = [&] { return job.helping == 0; };
    constexpr std::chrono::milliseconds kBetween{20};
    while (job.polls() && !one_is_done_.wait_for(lock, kBetween, is_done)) {
      lock.unlock();
      job.poll();
      lock.lock();
    }
    one_is_done_.wait(lock, is_done);
  }

 private:
  void call_for_help(Job& job, std::size_t most) {
    const std::scoped_lock lock(mutex_);
    try {
      while (threads_.size() < most) threads_.emplace_back([this] { help(); });
    } catch (const std::system_error&) {
      // The threads that exist do the work.
    }
    job.wanted = most;
    jobs_.push_back(&job);
    there_is_work_.notify_all();
  }

  void help() {
    const FloatEnvironment environment;
    std::unique_lock lock(mutex_);
    while (true) {
      there_is_work_.wait(lock, [this] { return ending_ || !jobs_.empty(); });
      if (ending_) return;
      Job& job = *jobs_.back();
      ++job.helping;
      if (--job.wanted == 0) jobs_.pop_back();
      lock.unlock();
      job.run_what_is_left();
      lock.lock();
      if (--job.helping == 0) one_is_done_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable there_is_work_, one_is_done_;
  std::vector<Job*> jobs_;
  bool ending_ = false;
  std::vector<std::thread> threads_;
};

Threads::Threads(unsigned requested)
    : count_(requested != 0 ? requested : std::max(1u, std::thread::hardware_concurrency())) {
  if (count_ > 1) helpers_ = std::make_shared<Helpers>();
}

Threads Threads::at_most(unsigned count) const {
  Threads some = *this;
  some.count_ = std::clamp(count, 1u, count_);
  return some;
}

Threads Threads::polling(std::function<void()> between) const {
  Threads polling = *this;
  polling.between_ = std::make_shared<const std::function<void()>>(std::move(between));
  polling.polls_on_ = std::this_thread::get_id();
  return polling;
}

void parallel(const Threads& threads, std::size_t count, const std::function<void(std::size_t)>& task) {
  if (count == 0) return;
  Job job(count, task, threads.between_.get());
  const std::size_t most = std::min<std::size_t>(threads.count(), count) - 1;
  if (most > 0) {
    threads.helpers_->run(job, most);
  } else {
    job.run_as_caller();
  }
  job.throw_first_error();
}

void parallel_ranges(const Threads& threads, std::size_t size,
                     const std::function<void(std::size_t first, std::size_t last)>& body) {
  std::size_t count = std::clamp<std::size_t>(size / kLeastRange, 1, threads.count());
  if (threads.between_) count = std::max(count, size / kPolledRange);
  parallel(threads, count, [&](std::size_t k) { body(size * k / count, size * (k + 1) / count); });
}

}  // namespace holdfast
