// The attempts of a call, with successive seeds until all points have double positions, or with chosen seeds.
// The result of the first is there when a later one begins, and stands if that one is no better or fails.
#pragma once

#include <cstdint>
#include <functional>

#include "api/input.h"
#include "api/optional_fillings.h"
#include "holdfast/holdfast.h"
#include "mesh/monitor.h"
#include "mesh/parallel.h"
#include "optimise/optimise.h"

namespace holdfast {

class Attempts {
 public:
  /// The arguments must outlive it; `limits` are those of the monitor.
  Attempts(Input& input, const Options& options, Limits& limits, const Threads& threads, Monitor& monitor,
           Result& result);
  Attempts(const Attempts&) = delete;
  Attempts& operator=(const Attempts&) = delete;

  /// Makes attempts until one has doubles for all points, at most five. On entry the result has the outcome
  /// `done` and the report so far.
  void run();

  using IsBetter = std::function<bool(const Result&)>;
  /// Makes another attempt, which replaces the result if it is done and `is_better`. Returns false if a limit
  /// or an error ended it.
  bool run_instead(const Options& options, std::uint64_t seed, const IsBetter& is_better);

  /// Of the last attempt of `run`: the worst Q without field points.
  [[nodiscard]] double worst_without_field() const { return worst_without_field_; }

 private:
  [[nodiscard]] std::size_t most_attempts() const;
  void run_next();
  bool run_again();
  bool run_after(Result& before, const std::function<void()>& attempt);

  Input& input_;
  const Options& options_;
  Limits& limits_;
  const Threads& threads_;
  Monitor& monitor_;
  Result& result_;
  std::uint64_t next_seed_;
  double worst_without_field_ = 0;
  OptionalFillings fillings_;
  const FillAnew fill_anew_;
};

}  // namespace holdfast
