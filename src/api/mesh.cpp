// A call of `mesh`: check the options, validate, then make attempts with successive seeds.
#include "api/mesh.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "api/attempt.h"
#include "api/bounds.h"
#include "api/course.h"
#include "api/fillings.h"
#include "api/input.h"
#include "api/judge.h"
#include "api/remote_components.h"
#include "api/report.h"
#include "holdfast/holdfast.h"
#include "mesh/memory.h"
#include "mesh/monitor.h"
#include "mesh/parallel.h"
#include "mesh/started.h"
#include "numbers/float_environment.h"

namespace holdfast {
namespace {

constexpr std::size_t kMostAttempts = 5;

// If the worst element is this many times as bad as the facets require, polyhedra around it are filled again;
// the factor is lower for few facets, where this costs almost nothing.
constexpr std::size_t kFewFacets = 1'000;
constexpr double kNearTarget = 3, kFarFromTarget = 10;

// If it still is, other random orders of the whole mesh may do better. Their seeds are fixed, so that runs
// with different seeds make the same choice. With many facets this takes long and needs a larger gain.
constexpr double kVeryFarFromTarget = 1'000;
constexpr std::size_t kOtherChoices = 8, kChoicesInVain = 4;
constexpr std::uint64_t kFirstOtherSeed = 0x9E3779B97F4A7C15;
constexpr std::size_t kMostFacetsForChoices = 5'000;

// Selects the overload that is not a template.
Result mesh_complex(const Complex& complex, const Options& options) { return mesh(complex, options); }

class Call {
 public:
  Call(const Complex& complex, const Options& options, SamePlace same_place, PartsOfComplex* parts = nullptr)
      : options_(options),
        limits_(started(options)),
        monitor_(limits_, options.progress),
        threads_(Threads(options.threads).polling([this] { poll(); })),
        input_(complex, same_place, options, threads_, monitor_, parts) {}

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
    try_once();
    while (result_.report.attempts < kMostAttempts && result_.outcome == Outcome::not_representable &&
           try_again()) {
    }
    const bool has_all = options_.stop_after.value_or(Stage::optimise) == Stage::optimise;
    if (result_.outcome == Outcome::done && has_all) try_other_choices();
    if (result_.outcome == Outcome::done && options_.sizes && has_all && options_.keep != Keep::box)
      mesh_remote_components(input_.complex(), options_of_component(), threads_, mesh_complex, result_);
    if (result_.outcome == Outcome::done && options_.sizes &&
        options_.stop_after.value_or(Stage::optimise) >= Stage::field_points)
      judge_bounds(options_, threads_, result_);
  }

  // For a component that is meshed separately after the rest.
  [[nodiscard]] Options options_of_component() {
    Options options = options_;
    static_cast<Limits&>(options) = limits_;
    options.sizes = input_.sizes();
    options.neighbours = false;  // computed later, for the whole volume
    if (options_.progress)
      options.progress = [this](const Progress& now) {
        return options_.progress({now.stage, now.fraction, monitor_.overall()});
      };
    return options;
  }

  // Only the caller's thread polls; nested jobs run on other threads.
  void poll() {
    if (std::this_thread::get_id() == caller_) monitor_.poll_again();
  }

  void validate() {
    Course(options_, monitor_, result_.report).run(CallStep::validate, [&] {
      std::vector<Defect> defects = input_.validate(result_.report.input);
      if (!defects.empty()) return refuse(result_, std::move(defects));
      judge_places();
    });
  }

  // Regions exist only in a valid surface, so defects are reported first.
  void judge_places() {
    std::optional<Options> without_parts;
    if (input_.parts() != nullptr) {
      without_parts = options_;
      without_parts->regions.resize(input_.parts()->seeds);
    }
    try {
      require_well_placed(input_.complex(), input_.table(), without_parts ? *without_parts : options_,
                          input_.names(), [&] { monitor_.poll(Stage::validate, 0.5); });
    } catch (const std::invalid_argument&) {
      std::vector<Defect> defects = input_.defects();
      if (defects.empty()) throw;
      refuse(result_, std::move(defects));
    }
  }

  void try_once() {
    Options options = options_;
    options.flips = options.flips && result_.report.attempts % 2 == 0;
    ++result_.report.attempts;
    worst_without_field_ = mesh_once({input_, options, seed_++, threads_, monitor_, &fill_anew_}, result_);
  }

  [[nodiscard]] std::optional<Filling> fill(const ToFill& asked, const LikelyToFill& likely) {
    try {
      // One limit for all fillings together.
      if (!end_of_filling_) end_of_filling_ = half_of_the_time();
      const LessTime half(limits_, *end_of_filling_);
      return fillings_.fill(asked, likely);
    } catch (const Interrupted& interrupted) {
      if (interrupted.outcome() != Outcome::time_limit) throw;
    } catch (const std::logic_error&) {
      warn_of(std::current_exception());
    }
    return std::nullopt;
  }

  // Shortens the time limit during its lifetime: for optional work, when a result exists that must still be
  // delivered and written within the limit.
  class LessTime {
   public:
    LessTime(Limits& limits, double limit) : limits_(limits), whole_(limits.time_limit) {
      if (whole_ > 0) limits.time_limit = std::min(whole_, limit);
    }
    LessTime(const LessTime&) = delete;
    LessTime& operator=(const LessTime&) = delete;
    ~LessTime() { limits_.time_limit = whole_; }

   private:
    Limits& limits_;
    const double whole_;
  };

  // Half of the time that is left, expressed as a time limit.
  [[nodiscard]] double half_of_the_time() const {
    const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - *limits_.started;
    return (gone.count() + limits_.time_limit) / 2;
  }

  // Flat elements are seldom forced. With field points, the mesh without them is judged, because it is the
  // standard for them; later effort does not count.
  void try_other_choices() {
    const double worst = options_.sizes ? worst_without_field_ : result_.report.elements.worst;
    const double far = far_from_target();
    if (!options_.optimise || !options_.add_points || !options_.flips || input_.parts() != nullptr ||
        !(worst > far) || input_.complex().facets.size() > kMostFacetsForChoices)
      return;
    const LessTime half(limits_, half_of_the_time());
    if (options_.sizes)
      choose_for_field(worst, far);
    else
      choose_the_best(far);
  }

  // The Q above which other orders of a mesh without field points are tried.
  [[nodiscard]] double far_from_target() {
    return (has_few_facets() ? kNearTarget : kVeryFarFromTarget) * input_.target();
  }

  [[nodiscard]] bool has_few_facets() const { return input_.complex().facets.size() <= kFewFacets; }

  void choose_the_best(double far) {
    std::size_t in_vain = 0;
    for (std::uint64_t k = 0;
         k < kOtherChoices && in_vain < kChoicesInVain && result_.report.elements.worst > far; ++k) {
      const double worst = result_.report.elements.worst;
      const bool goes_on = try_instead(options_, kFirstOtherSeed + k, [&](const Result& other) {
        in_vain = in_vain_with(other, worst, in_vain);
        return other.report.elements.worst < worst;
      });
      if (!goes_on) return;
    }
  }

  void choose_for_field(double worst, double far) {
    Options fill = options_;
    fill.sizes.reset();
    std::optional<std::uint64_t> best;
    std::size_t in_vain = 0;
    for (std::uint64_t k = 0; k < kOtherChoices && in_vain < kChoicesInVain && worst > far; ++k) {
      const bool goes_on = try_instead(fill, kFirstOtherSeed + k, [&](const Result& other) {
        in_vain = in_vain_with(other, worst, in_vain);
        if (other.report.elements.worst < worst) {
          worst = other.report.elements.worst;
          best = kFirstOtherSeed + k;
        }
        return false;
      });
      if (!goes_on) return;
    }
    if (best) try_instead(options_, *best, [](const Result&) { return true; });
  }

  // How many orders in a row gained less than a fifth. An identical worst element counts twice, because it is
  // seldom a coincidence.
  static std::size_t in_vain_with(const Result& other, double worst, std::size_t in_vain) {
    if (other.report.elements.worst < 0.8 * worst) return 0;
    return in_vain + (other.report.elements.worst == worst ? 2 : 1);
  }

  // Makes another attempt, which replaces the result if it is done and `is_better`. Returns false if a limit
  // or an error ended it.
  template <typename IsBetter>
  bool try_instead(const Options& options, std::uint64_t seed, IsBetter&& is_better) {
    Result before = std::exchange(result_, {});
    const auto mesh_anew = [&] { mesh_once({input_, options, seed, threads_, monitor_, nullptr}, result_); };
    if (!attempt_after(before, mesh_anew)) return false;
    if (result_.outcome != Outcome::done || !is_better(result_)) go_back_to(std::move(before));
    return true;
  }

  // If some point has no doubles, another random order may help, or an attempt without flips, which may have
  // placed the point: every other attempt uses none. The attempt with the fewest such points counts. Returns
  // false if a limit or an error ends the new one.
  bool try_again() {
    Result best = std::exchange(result_, {});
    const LessTime half(limits_, half_of_the_time());
    if (!attempt_after(best, [&] { try_once(); })) return false;
    if (result_.outcome == Outcome::not_representable &&
        result_.exact_vertices.size() >= best.exact_vertices.size())
      go_back_to(std::move(best));
    return true;
  }

  // If a limit or an error ends the attempt, restores `before` as the result and returns false.
  template <typename Attempted>
  bool attempt_after(Result& before, Attempted&& attempted) {
    try {
      result_.report = of_all_attempts(before.report);
      attempted();
      return true;
    } catch (const Interrupted& interrupted) {
      if (interrupted.outcome() == Outcome::cancelled) throw;
      go_back_to(std::move(before));
    } catch (...) {
      if (monitor_.caller_threw()) throw;
      go_back_to(std::move(before));
      warn_of(std::current_exception());
    }
    return false;
  }

  // The figures that accumulate over all attempts.
  static Report of_all_attempts(const Report& report) {
    Report sum;
    sum.input = report.input;
    sum.seconds = report.seconds;
    sum.attempts = report.attempts;
    sum.segment_points = report.segment_points;
    sum.facet_points = report.facet_points;
    return sum;
  }

  // Allocates nothing, since memory may have run out.
  void go_back_to(Result best) noexcept {
    const Report last = std::move(result_.report);
    result_ = std::move(best);
    Report& report = result_.report;
    for (auto& [stage, seconds] : report.seconds)
      if (const auto it = last.seconds.find(stage); it != last.seconds.end()) seconds = it->second;
    report.attempts = std::max(report.attempts, last.attempts);
    report.segment_points = std::max(report.segment_points, last.segment_points);
    report.facet_points = std::max(report.facet_points, last.facet_points);
  }

  void warn_of(const std::exception_ptr& error) noexcept {
    try {
      std::string what = "an unknown exception";
      try {
        std::rethrow_exception(error);
      } catch (const std::exception& thrown) {
        what = thrown.what();
      } catch (...) {  // NOLINT(bugprone-empty-catch): of a kind of its own
      }
      result_.warnings.push_back({WarningKind::attempt_failed,
                                  {},
                                  {},
                                  {},
                                  "attempt " + std::to_string(result_.report.attempts) +
                                      " ended by an error (" + what +
                                      "); the result of an earlier attempt is delivered"});
    } catch (...) {  // NOLINT(bugprone-empty-catch): there is no memory for the words
    }
  }

  void give_up(Outcome outcome) {
    result_.outcome = outcome;
    result_.message = interruption_message(outcome, monitor_.stage(), options_);
    result_.volume = {};
    result_.facet_regions.clear();
    result_.vertex_map.clear();
    result_.exact_vertices.clear();
  }

  const Options& options_;
  const std::thread::id caller_ = std::this_thread::get_id();
  Limits limits_;  // the caller's, or less time during optional work
  Monitor monitor_;
  const Threads threads_;
  Input input_;
  std::uint64_t seed_ = options_.seed;    // of the next attempt
  double worst_without_field_ = 0;        // of the last attempt
  std::optional<double> end_of_filling_;  // time limit for all fillings of polyhedra
  Fillings fillings_{limits_, monitor_, threads_};
  const FillAnew fill_anew_{
      [this](const ToFill& asked, const LikelyToFill& likely) { return fill(asked, likely); },
      has_few_facets() ? kNearTarget : kFarFromTarget};
  Result result_;
};

Result mesh_called(const Complex& complex, const Options& options, PartsOfComplex* parts) {
  const FloatEnvironment environment;
  require_sensible(complex, options);
  Result result = Call(complex, options, SamePlace::one_vertex, parts).run();
  const bool has_volume = result.outcome == Outcome::done || result.outcome == Outcome::not_representable;
  if (has_volume && complex.names != nullptr) result.volume.names = *complex.names;
  if (options.neighbours) result.neighbours = neighbours(result.volume.tetrahedra);
  return result;
}

}  // namespace

Result mesh(const Complex& complex, const Options& options) { return mesh_called(complex, options, nullptr); }

Result mesh_parts(const Complex& complex, const Options& options, PartsOfComplex& parts) {
  return mesh_called(complex, options, &parts);
}

Result mesh_as_given(const Complex& complex, const Options& options) {
  require_sensible(complex, options);
  return Call(complex, options, SamePlace::defect).run();
}

}  // namespace holdfast
