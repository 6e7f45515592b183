// Filling the report of a run.
#pragma once

#include <chrono>
#include <string>

#include "holdfast/holdfast.h"
#include "mesh/shape_counts.h"
#include "surface/complex.h"

namespace holdfast {

/// Counts of the input. `table` is null while the indices may be out of range.
[[nodiscard]] Report::Input describe_input(const Complex& complex, const SegmentTable* table);

/// The shape of a volume's elements, and the target for its facets.
[[nodiscard]] Report::Elements describe_elements(const VolumeShape& shape, double target);
[[nodiscard]] Report::Shape describe_shape(const ShapeCounts& counts);

/// Adds the time from its construction to its end to seconds[key], also when an exception ends it.
class Stopwatch {
 public:
  Stopwatch(Report& report, std::string key) : report_(report), key_(std::move(key)) {
    report_.seconds[key_];
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch();

 private:
  Report& report_;
  std::string key_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// One sentence on how and where a run ended early.
[[nodiscard]] std::string interruption_message(Outcome outcome, Stage stage, const Options& options);

}  // namespace holdfast
