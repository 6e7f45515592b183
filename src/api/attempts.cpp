#include "api/attempts.h"

#include <cstddef>
#include <exception>
#include <utility>

#include "api/attempt.h"
#include "api/earlier_result.h"
#include "api/far_from_target.h"
#include "api/less_time.h"

namespace holdfast {
namespace {

// Another order seldom rounds many points at once, and takes long on a large complex.
constexpr std::size_t kMostAttempts = 5, kMostAttemptsForMany = 2;
constexpr std::size_t kFewPoints = 3, kLargeComplex = 20'000;

}  // namespace

Attempts::Attempts(Input& input, const Options& options, Limits& limits, const Threads& threads,
                   Monitor& monitor, Result& result)
    : input_(input),
      options_(options),
      limits_(limits),
      threads_(threads),
      monitor_(monitor),
      result_(result),
      next_seed_(options.seed),
      fillings_(limits, monitor, threads, result),
      fill_anew_{
          [this](const ToFill& asked, const LikelyToFill& likely) { return fillings_.fill(asked, likely); },
          targets_for_fillings(input.complex())} {}

void Attempts::run() {
  run_next();
  while (result_.outcome == Outcome::not_representable && result_.report.attempts < most_attempts() &&
         run_again()) {
  }
}

std::size_t Attempts::most_attempts() const {
  const bool has_many =
      result_.exact_vertices.size() > kFewPoints && input_.complex().facets.size() > kLargeComplex;
  return has_many ? kMostAttemptsForMany : kMostAttempts;
}

void Attempts::run_next() {
  Options options = options_;
  options.flips = options.flips && result_.report.attempts % 2 == 0;
  ++result_.report.attempts;
  worst_without_field_ = mesh_once({input_, options, next_seed_++, threads_, monitor_, &fill_anew_}, result_);
}

// If some point has no doubles, another random order may help, or an attempt without flips, which may have
// placed the point: every other attempt uses none. The attempt with the fewest such points counts. Returns
// false if a limit or an error ends the new one.
bool Attempts::run_again() {
  Result best = std::exchange(result_, {});
  const LessTime half(limits_, half_of_the_time(limits_));
  if (!run_after(best, [&] { run_next(); })) return false;
  if (result_.outcome == Outcome::not_representable &&
      result_.exact_vertices.size() >= best.exact_vertices.size())
    go_back_to(std::move(best), result_);
  return true;
}

bool Attempts::run_instead(const Options& options, std::uint64_t seed, const IsBetter& is_better) {
  Result before = std::exchange(result_, {});
  const auto mesh_anew = [&] { mesh_once({input_, options, seed, threads_, monitor_, nullptr}, result_); };
  if (!run_after(before, mesh_anew)) return false;
  if (result_.outcome != Outcome::done || !is_better(result_)) go_back_to(std::move(before), result_);
  return true;
}

// If a limit or an error ends the attempt, restores `before` as the result and returns false.
bool Attempts::run_after(Result& before, const std::function<void()>& attempt) {
  try {
    result_.report = of_all_attempts(before.report);
    attempt();
    return true;
  } catch (const Interrupted& interrupted) {
    if (interrupted.outcome() == Outcome::cancelled) throw;
    go_back_to(std::move(before), result_);
  } catch (...) {
    if (monitor_.caller_threw()) throw;
    go_back_to(std::move(before), result_);
    warn_of(std::current_exception(), result_);
  }
  return false;
}

}  // namespace holdfast
