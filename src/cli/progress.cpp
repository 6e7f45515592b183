#include "progress.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>

#include "signals.h"

namespace holdfast::cli {
namespace {

constexpr int bar_width = 40;
constexpr std::chrono::milliseconds redraw_after{100};

}  // namespace

bool ProgressView::operator()(const Progress& progress) {
  const auto now = std::chrono::steady_clock::now();
  // Partition and elimination take turns; a stage is told when it first begins.
  const bool first_time = !stage_ || *stage_ < progress.stage;
  if (first_time) stage_ = progress.stage;
  if (show_ == Show::lines && first_time) {
    fmt::print(stderr, "[{:8.2f} s] {}\n", std::chrono::duration<double>(now - started_).count(),
               name(progress.stage));
  } else if (show_ == Show::bar && now - drawn_ >= redraw_after) {
    drawn_ = now;
    draw_bar(progress);
  }
  return !cancel_requested();
}

void ProgressView::draw_bar(const Progress& progress) const {
  const double fraction = std::clamp(progress.fraction, 0.0, 1.0);
  const int filled = static_cast<int>(fraction * bar_width);
  fmt::print(stderr, "\r{:<10} [{:=<{}}{:{}}] {:3.0f} %", name(progress.stage), "", filled, "",
             bar_width - filled, 100 * fraction);
  std::fflush(stderr);
}

void ProgressView::finish() {
  if (show_ == Show::bar && stage_) fmt::print(stderr, "\r{:{}}\r", "", bar_width + 20);
  stage_.reset();
}

}  // namespace holdfast::cli
