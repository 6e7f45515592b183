// The progress of a mesh as the user sees it.
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
  lines,  ///< one line per stage
};

/// The display for --quiet and --verbose: by default a bar if stderr is a terminal.
[[nodiscard]] Show how_to_show(bool quiet, bool verbose);

/// Shows progress on stderr and obeys Ctrl-C; the progress callback of `mesh` and `untangle`. One bar covers
/// the whole command and never goes back.
class ProgressView {
 public:
  explicit ProgressView(Show show);
  ~ProgressView() { finish(); }
  ProgressView(const ProgressView&) = delete;
  ProgressView& operator=(const ProgressView&) = delete;

  /// Returns false if the user asked to stop.
  bool operator()(const Progress& progress);
  bool operator()(const UntangleProgress& progress);
  /// For the repair before the mesh. Returns false if the user asked to stop.
  bool repairing(double fraction);
  /// Files are being read or written; for large ones this takes long and has no progress of its own.
  void reading();
  void writing();
  /// Removes the bar from the terminal.
  void finish();

 private:
  bool tell(int order, const char* what, double share);  ///< `share` of the whole command
  void show_bar(const char* what, bool at_once);
  [[nodiscard]] double seconds() const;
  [[nodiscard]] std::string time_left() const;

  Show show_;
  std::optional<int> order_;  // of the last message
  double share_ = 0;          // of the whole command
  std::size_t drawn_columns_ = 0;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point drawn_ = started_;
};

}  // namespace holdfast::cli
