// Limits on a whole command: --time-limit, --memory-limit and signals, while it computes, reads and writes.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>

#include "holdfast/holdfast.h"
#include "holdfast/io.h"
#include "holdfast/limits.h"

namespace holdfast::cli {

/// What --time-limit and --memory-limit were given.
struct LimitArguments {
  std::optional<double> time_limit, memory_limit;
};

void add_limits(CLI::App& command, LimitArguments& arguments);

/// Of a command that begins now, and of signals once `cancel_by_flag` was called. Throws UsageError for
/// numbers that are no limits.
[[nodiscard]] Limits limits_of(const LimitArguments& arguments);

/// The message for a call without an outcome that a limit or a signal ended, in the words of calls with an
/// outcome.
[[nodiscard]] std::string message_of(const Interrupted& interrupted, const Limits& limits);

/// Runs work that has no outcome: reading, writing, some calls. If a limit or a signal ends the work, or it
/// needs more memory or numbers than there are, `report` gets the outcome and its message, as for calls with
/// an outcome, before the exception is rethrown.
template <class Work, class Report>
auto work_or_report(const Limits& limits, const Work& work, const Report& report) {
  try {
    return work();
  } catch (const Interrupted& interrupted) {
    report(interrupted.outcome(), message_of(interrupted, limits));
    throw;
  } catch (const std::length_error& large) {
    report(Outcome::memory_limit, large.what());
    throw;
  } catch (const std::bad_alloc&) {
    report(Outcome::memory_limit, "out of memory");
    throw;
  }
}

/// The report of a command that was ended before it found anything.
void write_end(const std::filesystem::path& path, Outcome outcome, const std::string& message);

/// As work_or_report, where all that there is to report is how it ended, in each of these files.
template <class Work>
auto work_or_write_end(const Limits& limits, const Work& work,
                       std::initializer_list<std::filesystem::path> reports) {
  return work_or_report(limits, work, [&](Outcome outcome, const std::string& message) {
    for (const std::filesystem::path& path : reports) write_end(path, outcome, message);
  });
}

/// Limits for reading, which obeys signals once `cancel_by_flag` was called.
[[nodiscard]] ReadOptions reading(const Limits& limits, const std::string& format, double tolerance = 0);

/// Why text is no number of 64 bits without a sign, which would become another one without a word; else "".
[[nodiscard]] std::string not_a_count(const std::string& text);

/// --seed.
void add_seed(CLI::App& command, std::uint64_t& seed,
              const char* help = "Seed of the random orders (default 1)");

/// --tolerance, for polygons.
void add_tolerance(CLI::App& command, double& tolerance);

/// Lets limits and signals end the writing of a file.
void watch_writing(WriteOptions& options, const Limits& limits);

/// Says that a command ended by a limit or a signal, which `outcome` must be, and what helps; returns the
/// exit code. `message` is that of the result.
int tell_limit(Outcome outcome, const std::string& message);

/// For `progress` of calls that tell nothing: false after a signal.
[[nodiscard]] bool goes_on(double fraction);

}  // namespace holdfast::cli
