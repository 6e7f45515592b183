#include "progress.h"

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "command.h"
#include "signals.h"

namespace holdfast::cli {
namespace {

constexpr std::size_t most_bar_width = 40;
constexpr std::chrono::milliseconds redraw_after{100};
// The mesher's part of the whole command. Files are read before it and written after it.
constexpr double mesher_begins = 0.02, mesher_ends = 0.96;
// The end of a repair before the mesh; the bar waits until the mesher has got this far.
constexpr double repair_ends = 0.2;

double share_of_mesher(double fraction) {
  return std::lerp(mesher_begins, mesher_ends, std::clamp(fraction, 0.0, 1.0));
}

std::size_t terminal_columns() {
  constexpr std::size_t usual = 80;
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

}  // namespace

Show how_to_show(bool quiet, bool verbose) {
  if (quiet) return Show::nothing;
  if (verbose) return Show::lines;
  return isatty(STDERR_FILENO) != 0 ? Show::bar : Show::nothing;
}

ProgressView::ProgressView(Show show) : show_(show) {}

bool ProgressView::operator()(const Progress& progress) {
  return tell(static_cast<int>(progress.stage), name(progress.stage), share_of_mesher(progress.overall));
}

bool ProgressView::operator()(const UntangleProgress& progress) {
  return tell(static_cast<int>(progress.step), name(progress.step), share_of_mesher(progress.fraction));
}

bool ProgressView::repairing(double fraction) {
  constexpr int before_all_stages = -1;
  return tell(before_all_stages, "repair",
              std::lerp(mesher_begins, repair_ends, std::clamp(fraction, 0.0, 1.0)));
}

bool ProgressView::tell(int order, const char* what, double share) {
  // Some stages and steps alternate; each is printed when it first begins.
  const bool first_time = !order_ || *order_ < order;
  if (first_time) order_ = order;
  if (show_ == Show::lines && first_time) say("[{:8.2f} s] {}\n", seconds(), what);
  share_ = std::max(share_, share);
  show_bar(what, false);
  return !cancel_requested();
}

void ProgressView::reading() { show_bar("read", true); }

void ProgressView::writing() {
  share_ = std::max(share_, mesher_ends);
  show_bar("write", seconds() > 1);
}

void ProgressView::show_bar(const char* what, bool at_once) {
  const auto now = std::chrono::steady_clock::now();
  if (show_ != Show::bar || (!at_once && now - drawn_ < redraw_after)) return;
  drawn_ = now;
  const std::string left = time_left();
  constexpr std::size_t beside = 12 + 4 + 5;  // the stage's name, brackets and spaces, percentage
  const std::size_t columns = terminal_columns();
  const std::size_t room = columns > beside + left.size() + 1 ? columns - beside - left.size() - 1 : 0;
  const std::size_t width = std::min(room, most_bar_width);
  const auto filled = static_cast<std::size_t>(share_ * static_cast<double>(width));
  std::string line = fmt::format("{:<12} [{:=<{}}{:{}}] {:3.0f} %{}", what, "", filled, "", width - filled,
                                 std::floor(100 * share_), left);
  line.resize(std::min(line.size(), columns - 1));
  const std::size_t length = line.size();
  if (length < drawn_columns_) line.append(drawn_columns_ - length, ' ');
  drawn_columns_ = length;
  say("\r{}", line);
  std::fflush(stderr);
}

double ProgressView::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

// Extrapolates from the work done; shown on runs that take more than a few seconds.
std::string ProgressView::time_left() const {
  constexpr double too_soon = 2, too_little = 0.05;
  const double done = seconds();
  if (done < too_soon || share_ < too_little) return {};
  const auto left = static_cast<long>(std::ceil(done * (1 - share_) / share_));
  constexpr long minute = 60, hour = 3600;
  if (left >= hour) return fmt::format(", {}:{:02} h left", left / hour, left % hour / minute);
  return fmt::format(", {}:{:02} left", left / minute, left % minute);
}

void ProgressView::finish() {
  if (drawn_columns_ > 0) {
    say("\r{:{}}\r", "", drawn_columns_);
    std::fflush(stderr);
  }
  drawn_columns_ = 0;
  order_.reset();
}

}  // namespace holdfast::cli
