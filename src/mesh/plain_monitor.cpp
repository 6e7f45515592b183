#include "mesh/plain_monitor.h"

#include <stdexcept>
#include <utility>

namespace holdfast {
namespace {

const Limits& sensible(const Limits& limits) {
  if (!(limits.time_limit >= 0)) throw std::invalid_argument("the time limit must not be negative");
  return limits;
}

}  // namespace

PlainMonitor::PlainMonitor(const Limits& limits, ProgressFunction progress)
    : progress_(std::move(progress)),
      tell_(progress_ ? std::function<bool(const Progress&)>(
                            [this](const Progress& done) { return progress_(done.overall); })
                      : nullptr),
      monitor_(sensible(limits), tell_) {}

}  // namespace holdfast
