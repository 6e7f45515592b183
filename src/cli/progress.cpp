#include "progress.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>

#include "command.h"
#include "signals.h"

namespace holdfast::cli {
namespace {

constexpr int bar_width = 40;
constexpr std::chrono::milliseconds redraw_after{100};

}  // namespace

bool ProgressView::operator()(const Progress& progress) {
  return tell(static_cast<int>(progress.stage), name(progress.stage), progress.fraction);
}

bool ProgressView::operator()(const UntangleProgress& progress) {
  return tell(static_cast<int>(progress.step), name(progress.step), progress.fraction);
}

bool ProgressView::tell(int order, const char* what, double fraction) {
  const auto now = std::chrono::steady_clock::now();
  // Some stages and steps take turns; each is told when it first begins.
  const bool first_time = !order_ || *order_ < order;
  if (first_time) order_ = order;
  if (show_ == Show::lines && first_time) {
    say("[{:8.2f} s] {}\n", std::chrono::duration<double>(now - started_).count(), what);
  } else if (show_ == Show::bar && now - drawn_ >= redraw_after) {
    drawn_ = now;
    draw_bar(what, fraction);
  }
  return !cancel_requested();
}

void ProgressView::draw_bar(const char* what, double fraction) {
  const double share = std::clamp(fraction, 0.0, 1.0);
  const int filled = static_cast<int>(share * bar_width);
  say("\r{:<10} [{:=<{}}{:{}}] {:3.0f} %", what, "", filled, "", bar_width - filled, 100 * share);
  std::fflush(stderr);
}

void ProgressView::finish() {
  if (show_ == Show::bar && order_) say("\r{:{}}\r", "", bar_width + 20);
  order_.reset();
}

}  // namespace holdfast::cli
