// What the user sees while a mesh is made.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "holdfast/untangle.h"

namespace holdfast::cli {

/// Where progress goes.
enum class Show {
  nothing,
  bar,    ///< one line on a terminal, rewritten in place and erased at the end
  lines,  ///< one line a stage
};

/// What suits --quiet and --verbose: a bar where standard error is a terminal, if neither was given.
[[nodiscard]] Show how_to_show(bool quiet, bool verbose);

/// Shows progress on stderr and hears Ctrl-C; the progress callback of `mesh` and `untangle`. The bar is one
/// for the whole command and never goes back.
class ProgressView {
 public:
  explicit ProgressView(Show show);
  ~ProgressView() { finish(); }
  ProgressView(const ProgressView&) = delete;
  ProgressView& operator=(const ProgressView&) = delete;

  /// False when the user asked to stop.
  bool operator()(const Progress& progress);
  bool operator()(const UntangleProgress& progress);
  /// Of the repair before the mesh. False when the user asked to stop.
  bool repairing(double fraction);
  /// Files are read or written, which takes long for large ones and tells nothing meanwhile.
  void reading();
  void writing();
  /// Takes the bar off the terminal.
  void finish();

 private:
  bool tell(int order, const char* what, double share);  ///< a share of the whole command
  void show_bar(const char* what, bool at_once);
  [[nodiscard]] double seconds() const;
  [[nodiscard]] std::string time_left() const;

  Show show_;
  std::optional<int> order_;  // of what was told last
  double share_ = 0;          // of the whole command
  std::size_t drawn_columns_ = 0;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point drawn_ = started_;
};

}  // namespace holdfast::cli
