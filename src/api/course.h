// The steps of a call in their order, and the progress of the call by the usual cost of its steps.
#pragma once

#include <cstddef>
#include <type_traits>

#include "api/report.h"
#include "holdfast/holdfast.h"
#include "mesh/monitor.h"

namespace holdfast {

/// The steps of a call in order: stages, but that validation goes on after Delaunay and that the volume is
/// taken out of the mesh in the end.
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

/// Runs the steps of a call: measures their time, tells the monitor, and leaves out those after the stage at
/// which the call stops.
class Course {
 public:
  /// All three must outlive the course.
  Course(const Options& options, Monitor& monitor, Report& report);

  /// What `make` returns; an empty value of its type, without a call, if the call stops before the step.
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
  /// Tells the monitor which part of the whole call the step is.
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
