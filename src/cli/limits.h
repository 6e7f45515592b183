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

/// The values of --time-limit and --memory-limit.
struct LimitArguments {
  std::optional<double> time_limit, memory_limit;
};

void add_limits(CLI::App& command, LimitArguments& arguments);

/// The limits of a command that begins now; signals count after `cancel_by_flag`. Throws UsageError for
/// numbers that are no limits.
[[nodiscard]] Limits limits_of(const LimitArguments& arguments);

/// The message when a limit or a signal ended a call without an outcome, in the words of calls with one.
[[nodiscard]] std::string message_of(const Interrupted& interrupted, const Limits& limits);

/// Runs work that has no outcome: reading, writing, some calls. If a limit or a signal ends it, or it runs
/// out of memory or indices, `report` gets the outcome and its message, as for calls with an outcome, before
/// the exception is rethrown.
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

/// The report of a command that ended before it found anything.
void write_end(const std::filesystem::path& path, Outcome outcome, const std::string& message);

/// As work_or_report, for reports that only tell how the command ended, in each of these files.
template <class Work>
auto work_or_write_end(const Limits& limits, const Work& work,
                       std::initializer_list<std::filesystem::path> reports) {
  return work_or_report(limits, work, [&](Outcome outcome, const std::string& message) {
    for (const std::filesystem::path& path : reports) write_end(path, outcome, message);
  });
}

/// Limits for reading; signals count after `cancel_by_flag`.
[[nodiscard]] ReadOptions reading(const Limits& limits, const std::string& format, double tolerance = 0);

/// Why a text is not an unsigned number of 64 bits, which CLI11 would silently convert; empty if it is one.
[[nodiscard]] std::string not_a_count(const std::string& text);

/// --seed.
void add_seed(CLI::App& command, std::uint64_t& seed,
              const char* help = "Seed of the random orders (default 1)");

/// --tolerance, for polygons.
void add_tolerance(CLI::App& command, double& tolerance);

/// Lets limits and signals end the writing of a file.
void watch_writing(WriteOptions& options, const Limits& limits);

/// Reports that a limit or a signal ended the command, which `outcome` must say, and what helps; returns the
/// exit code. `message` is that of the result.
int tell_limit(Outcome outcome, const std::string& message);

/// A `progress` callback that shows nothing: false after a signal.
[[nodiscard]] bool goes_on(double fraction);

}  // namespace holdfast::cli
