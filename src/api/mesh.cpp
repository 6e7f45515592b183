// A call of `mesh`: checks the options, validates, makes attempts (attempts.h) and tries other choices
// (other_choices.h), and tells how a call that is ended early ended.
#include "api/mesh.h"

#include <new>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "api/attempt.h"
#include "api/attempts.h"
#include "api/bounds.h"
#include "api/course.h"
#include "api/input.h"
#include "api/judge.h"
#include "api/other_choices.h"
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
    Attempts attempts(input_, options_, limits_, threads_, monitor_, result_);
    attempts.run();
    const bool has_all = options_.stop_after.value_or(Stage::optimise) == Stage::optimise;
    if (result_.outcome == Outcome::done && has_all)
      try_other_choices(attempts, input_, options_, limits_, result_);
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
