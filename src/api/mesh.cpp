// A call of `mesh`: judge the options, validate, then attempts with one seed after the other.
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

// Where the worst element is so many times as bad as the facets ask for, polyhedra round it are filled anew:
// from fewer times on where facets are few, and that costs next to nothing.
constexpr std::size_t kFewFacets = 1'000;
constexpr double kNearTarget = 3, kFarFromTarget = 10;

// Where it still is, other random orders of the whole may do better: these, whatever the seed, so that runs
// with different seeds end with the same choice. With many facets that takes long, and has to be worth it.
constexpr double kVeryFarFromTarget = 1'000;
constexpr std::size_t kOtherChoices = 8, kChoicesInVain = 4;
constexpr std::uint64_t kFirstOtherSeed = 0x9E3779B97F4A7C15;
constexpr std::size_t kMostFacetsForChoices = 5'000;

// The one of the overloads that is no template.
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

  // Of a component that is meshed alone when the rest is done.
  [[nodiscard]] Options options_of_component() {
    Options options = options_;
    static_cast<Limits&>(options) = limits_;
    options.sizes = input_.sizes();
    options.neighbours = false;  // those of the whole volume follow
    if (options_.progress)
      options.progress = [this](const Progress& now) {
        return options_.progress({now.stage, now.fraction, monitor_.overall()});
      };
    return options;
  }

  // Jobs within jobs have other callers.
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

  // Regions of a surface that is not valid are none, so that is told first.
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
      // All of them together.
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

  // As long as it lives, this is all the time there is: for what may be done without, when a result is there
  // that has to be delivered, and written, within the limit.
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

  // Half of what is left, in the terms of the limit.
  [[nodiscard]] double half_of_the_time() const {
    const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - *limits_.started;
    return (gone.count() + limits_.time_limit) / 2;
  }

  // What is flat is seldom forced. With field points the choice is that of the mesh without, to which they
  // are held, whatever they and the effort have made of it.
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

  // The Q above which a mesh without field points is not left as it is.
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

  // How many orders in a row have not gained a fifth. The same worst element says as much as two others: it
  // is seldom there by chance.
  static std::size_t in_vain_with(const Result& other, double worst, std::size_t in_vain) {
    if (other.report.elements.worst < 0.8 * worst) return 0;
    return in_vain + (other.report.elements.worst == worst ? 2 : 1);
  }

  // Another attempt in the place of the result, if it is done and `is_better`. Returns false where a limit or
  // an error has ended it.
  template <typename IsBetter>
  bool try_instead(const Options& options, std::uint64_t seed, IsBetter&& is_better) {
    Result before = std::exchange(result_, {});
    const auto mesh_anew = [&] { mesh_once({input_, options, seed, threads_, monitor_, nullptr}, result_); };
    if (!attempt_after(before, mesh_anew)) return false;
    if (result_.outcome != Outcome::done || !is_better(result_)) go_back_to(std::move(before));
    return true;
  }

  // Where no doubles were found for some point, others may be with another random order, or where flips have
  // not put the points there: every other attempt leaves them out. The attempt with the fewest such points
  // counts, also where a limit or an error ends the next one: then returns false.
  bool try_again() {
    Result best = std::exchange(result_, {});
    const LessTime half(limits_, half_of_the_time());
    if (!attempt_after(best, [&] { try_once(); })) return false;
    if (result_.outcome == Outcome::not_representable &&
        result_.exact_vertices.size() >= best.exact_vertices.size())
      go_back_to(std::move(best));
    return true;
  }

  // Where a limit or an error ends the attempt, `before` is the result again; then returns false.
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

  // What counts over all attempts.
  static Report of_all_attempts(const Report& report) {
    Report sum;
    sum.input = report.input;
    sum.seconds = report.seconds;
    sum.attempts = report.attempts;
    sum.segment_points = report.segment_points;
    sum.facet_points = report.facet_points;
    return sum;
  }

  // Asks for no memory, which may be what there is none of.
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
                                      "); what an earlier one had is delivered"});
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
  Limits limits_;  // the caller's, or less while something is tried that may be left
  Monitor monitor_;
  const Threads threads_;
  Input input_;
  std::uint64_t seed_ = options_.seed;    // of the next attempt
  double worst_without_field_ = 0;        // of the last one
  std::optional<double> end_of_filling_;  // polyhedra, as a time limit
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
