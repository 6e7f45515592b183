// What the user sees while a mesh is made.
#pragma once

#include <chrono>
#include <optional>

#include "holdfast/untangle.h"

namespace holdfast::cli {

/// Where progress goes.
enum class Show {
  nothing,
  bar,    ///< one line on a terminal, rewritten in place and erased at the end
  lines,  ///< one line a stage
};

/// Shows progress on stderr and hears Ctrl-C; the progress callback of `mesh` and `untangle`.
class ProgressView {
 public:
  explicit ProgressView(Show show) : show_(show) {}
  ~ProgressView() { finish(); }
  ProgressView(const ProgressView&) = delete;
  ProgressView& operator=(const ProgressView&) = delete;

  /// False when the user asked to stop.
  bool operator()(const Progress& progress);
  bool operator()(const UntangleProgress& progress);
  /// Takes the bar off the terminal.
  void finish();

 private:
  bool tell(int order, const char* what, double fraction);
  static void draw_bar(const char* what, double fraction);

  Show show_;
  std::optional<int> order_;  // of what was told last
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point drawn_{};
};

}  // namespace holdfast::cli
