#include "api/earlier_result.h"

#include <algorithm>
#include <string>
#include <utility>

namespace holdfast {

Report of_all_attempts(const Report& report) {
  Report sum;
  sum.input = report.input;
  sum.seconds = report.seconds;
  sum.attempts = report.attempts;
  sum.segment_points = report.segment_points;
  sum.facet_points = report.facet_points;
  return sum;
}

void go_back_to(Result earlier, Result& result) noexcept {
  const Report last = std::move(result.report);
  result = std::move(earlier);
  Report& report = result.report;
  for (auto& [stage, seconds] : report.seconds)
    if (const auto it = last.seconds.find(stage); it != last.seconds.end()) seconds = it->second;
  report.attempts = std::max(report.attempts, last.attempts);
  report.segment_points = std::max(report.segment_points, last.segment_points);
  report.facet_points = std::max(report.facet_points, last.facet_points);
}

void warn_of(const std::exception_ptr& error, Result& result) noexcept {
  try {
    std::string what = "an unknown exception";
    try {
      std::rethrow_exception(error);
    } catch (const std::exception& thrown) {
      what = thrown.what();
    } catch (...) {  // NOLINT(bugprone-empty-catch): of a kind of its own
    }
    result.warnings.push_back({WarningKind::attempt_failed,
                               {},
                               {},
                               {},
                               "attempt " + std::to_string(result.report.attempts) + " ended by an error (" +
                                   what + "); the result of an earlier attempt is delivered"});
  } catch (...) {  // NOLINT(bugprone-empty-catch): there is no memory for the words
  }
}

}  // namespace holdfast
