// A call of `mesh`: judge the options, validate, then attempts with one seed after the other.
#include <new>
#include <utility>

#include "api/attempt.h"
#include "api/input.h"
#include "api/judge.h"
#include "api/remote_components.h"
#include "api/report.h"
#include "holdfast/holdfast.h"
#include "mesh/monitor.h"
#include "mesh/parallel.h"
#include "numbers/float_environment.h"

namespace holdfast {
namespace {

constexpr int kMostAttempts = 5;

class Call {
 public:
  Call(const Complex& complex, const Options& options)
      : options_(options),
        threads_(options.threads),
        monitor_(options),
        input_(complex, options, threads_, monitor_) {}

  Result run() {
    {
      const Stopwatch total(result_.report, "total");
      try {
        run_stages();
      } catch (const Interrupted& interrupted) {
        give_up(interrupted.outcome());
      } catch (const std::bad_alloc&) {
        if (options_.memory_limit == 0) throw;
        give_up(Outcome::memory_limit);
      }
    }
    result_.report.peak_memory_bytes = peak_memory_bytes();
    return std::move(result_);
  }

 private:
  void run_stages() {
    validate();
    if (result_.outcome != Outcome::done) return;
    attempt(input_, options_, options_.seed, threads_, monitor_, result_);
    int attempts = 1;
    while (attempts++ < kMostAttempts && result_.outcome == Outcome::not_representable && try_again()) {
    }
    const bool has_all = options_.stop_after.value_or(Stage::optimise) == Stage::optimise;
    if (result_.outcome == Outcome::done && options_.sizes && has_all && options_.keep != Keep::box)
      mesh_remote_components(input_.complex(), options_, mesh, result_);
  }

  void validate() {
    const Stopwatch watch(result_.report, name(Stage::validate));
    monitor_.enter(Stage::validate);
    if (std::vector<Defect> defects = input_.validate(result_.report.input); !defects.empty())
      refuse(result_, std::move(defects));
  }

  // Where no doubles were found for some point, others may be with another random order, or where flips have
  // not put the points there: every other attempt leaves them out. The attempt with the fewest such points
  // counts, also where a limit ends the next one: then returns false.
  bool try_again() {
    Result best = std::move(result_);
    result_ = {};
    result_.report = best.report;
    ++seed_;
    Options options = options_;
    options.flips = options.flips && (seed_ - options.seed) % 2 == 0;
    try {
      attempt(input_, options, seed_, threads_, monitor_, result_);
    } catch (const Interrupted& interrupted) {
      if (interrupted.outcome() == Outcome::cancelled) throw;
      result_ = std::move(best);
      return false;
    }
    if (result_.outcome == Outcome::not_representable &&
        result_.exact_vertices.size() >= best.exact_vertices.size()) {
      best.report.seconds = result_.report.seconds;
      result_ = std::move(best);
    }
    return true;
  }

  void give_up(Outcome outcome) {
    result_.outcome = outcome;
    result_.message = interruption_message(outcome, monitor_.stage(), options_);
    result_.volume = {};
    result_.facet_regions.clear();
    result_.exact_vertices.clear();
  }

  const Options& options_;
  const Threads threads_;
  Monitor monitor_;
  Input input_;
  std::uint64_t seed_ = options_.seed;
  Result result_;
};

}  // namespace

Result mesh(const Complex& complex, const Options& options) {
  const FloatEnvironment environment;
  require_sensible(complex, options);
  return Call(complex, options).run();
}

}  // namespace holdfast
