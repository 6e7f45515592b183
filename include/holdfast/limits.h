// Holdfast: limits, cancellation and progress of calls.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>

#include "holdfast/export.h"

namespace holdfast {

/// How a call ended.
enum class Outcome {
  done,
  invalid_input,      ///< `defects` says which rule is broken and where
  time_limit,         ///< `Limits::time_limit` ran out
  memory_limit,       ///< `Limits::memory_limit` was reached
  cancelled,          ///< the progress callback returned false, or the token was cancelled
  not_representable,  ///< valid, but some Steiner point has no position in doubles, or a volume bound no mesh
};

/// Whether a limit or the caller ended the call.
[[nodiscard]] constexpr bool is_interruption(Outcome outcome) {
  return outcome == Outcome::time_limit || outcome == Outcome::memory_limit || outcome == Outcome::cancelled;
}

/// Stops calls from another thread. Copies share one state: keep one copy and give another to
/// `Limits::cancel`. Many calls may share a token. A cancelled token stays cancelled.
class CancelToken {
 public:
  /// May be called from any thread and from a signal handler.
  void cancel() const noexcept { state_->store(true, std::memory_order_relaxed); }
  [[nodiscard]] bool cancelled() const noexcept { return state_->load(std::memory_order_relaxed); }

 private:
  static_assert(std::atomic<bool>::is_always_lock_free);
  std::shared_ptr<std::atomic<bool>> state_ = std::make_shared<std::atomic<bool>>(false);
};

/// Limits that end a call early. They are checked every 50 ms, or more often.
struct Limits {
  double time_limit = 0;  ///< seconds; 0: none
  /// When the time limit began to run, if before the call.
  std::optional<std::chrono::steady_clock::time_point> started = {};
  /// Bytes of the process; 0: none. Refused if the system does not report the memory of a process.
  std::uint64_t memory_limit = 0;
  std::optional<CancelToken> cancel = {};
};

/// Called every 20 ms or so from the calling thread, with the share of the work that is done, 0 to 1. Returns
/// false to cancel. An exception from it ends the call.
using ProgressFunction = std::function<bool(double)>;

/// Thrown by calls whose result has no `Outcome` (diagnose, check, delaunay, readers and writers) when a
/// limit is reached or the caller cancels. Nothing is left under the name of a file that was being written.
class HOLDFAST_API Interrupted : public std::exception {
 public:
  explicit Interrupted(Outcome outcome) noexcept : outcome_(outcome) {}
  /// time_limit, memory_limit or cancelled.
  [[nodiscard]] Outcome outcome() const noexcept { return outcome_; }
  [[nodiscard]] const char* what() const noexcept override;

 private:
  Outcome outcome_;
};

}  // namespace holdfast
