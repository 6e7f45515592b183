// Shared by calls that repair or paste: turns limits into outcomes.
#pragma once

#include <chrono>
#include <new>
#include <string>

#include "arrange/arrange.h"
#include "holdfast/repair.h"
#include "mesh/limit_message.h"
#include "mesh/memory.h"
#include "mesh/plain_monitor.h"

namespace holdfast {

/// Calls work(monitor), and fills the members that all these reports share.
template <class Work>
void run_within(const Limits& limits, const ProgressFunction& progress, RepairResult& result, Work&& work) {
  const auto begin = std::chrono::steady_clock::now();
  const auto end = [&](Outcome outcome, std::string message) {
    result.outcome = outcome;
    result.message = std::move(message);
  };
  try {
    PlainMonitor monitor(limits, progress);
    monitor.tell(0);
    work(monitor);
    monitor.tell(1);
  } catch (const Interrupted& interrupted) {
    end(interrupted.outcome(), limit_message(interrupted.outcome(), limits));
  } catch (const arrange::TooManyPoints& many) {
    end(Outcome::memory_limit,
        "the arrangement has too many new points (" + std::to_string(many.count()) + " so far)");
  } catch (const std::bad_alloc&) {
    if (limits.memory_limit == 0) throw;
    end(Outcome::memory_limit, limit_message(Outcome::memory_limit, limits));
  }
  result.report.seconds["total"] =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.report.peak_memory_bytes = peak_memory_bytes();
}

}  // namespace holdfast
