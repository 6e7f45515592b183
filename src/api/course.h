// The steps of a call in order, and the progress of the call by their usual cost.
#pragma once

#include <cstddef>
#include <type_traits>

#include "api/report.h"
#include "holdfast/holdfast.h"
#include "mesh/monitor.h"

namespace holdfast {

/// The steps of a call in order: the stages, except that validation continues after Delaunay and that
/// delivery comes last.
enum class CallStep : std::size_t {
  validate,
  delaunay,
  validate_missing,
  flips,
  partition,
  classify,
  suppress,
  field_points,
  optimise,
  deliver
};

/// Runs the steps of a call: measures their time, informs the monitor, and skips those after the last stage
/// requested.
class Course {
 public:
  /// The arguments must outlive the course.
  Course(const Options& options, Monitor& monitor, Report& report);

  /// Returns what `make` returns. If the call stops before the step, returns an empty value without a call of
  /// `make`.
  template <typename Make>
  auto run(CallStep step, Make&& make) const {
    using Made = decltype(make());
    if (!reaches(step)) return Made();
    const Stopwatch watch(report_, name(stage_of(step)));
    begin(step);
    monitor_.enter(stage_of(step));
    if constexpr (std::is_void_v<Made>) {
      make();
      monitor_.end_part();
    } else {
      Made made = make();
      monitor_.end_part();
      return made;
    }
  }
  /// Informs the monitor which part of the whole call the step is.
  void begin(CallStep step) const;
  [[nodiscard]] bool reaches(CallStep step) const { return step <= last_; }

 private:
  [[nodiscard]] static Stage stage_of(CallStep step);

  const Options& options_;
  Monitor& monitor_;
  Report& report_;
  CallStep last_;
};

}  // namespace holdfast
