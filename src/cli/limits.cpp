#include "limits.h"

#include <cerrno>
#include <cmath>
#include <cstdlib>

#include "command.h"
#include "mesh_options.h"
#include "report.h"
#include "signals.h"

namespace holdfast::cli {

void add_limits(CLI::App& command, LimitArguments& arguments) {
  command.add_option("--time-limit", arguments.time_limit, "Give up after this many seconds (exit 5)")
      ->option_text("S");
  command.add_option("--memory-limit", arguments.memory_limit, "Give up above this much memory (exit 5)")
      ->option_text("GB");
}

Limits limits_of(const LimitArguments& arguments) {
  Limits limits;
  limits.started = std::chrono::steady_clock::now();
  limits.time_limit = time_limit_of(arguments.time_limit);
  limits.memory_limit = memory_limit_of(arguments.memory_limit);
  limits.cancel = cancel_token();
  return limits;
}

int tell_limit(Outcome outcome, const std::string& message) {
  if (outcome == Outcome::cancelled)
    say("holdfast: cancelled; nothing was written\n");
  else
    say("holdfast: {}; nothing was written; give a {}\n", message,
        outcome == Outcome::time_limit ? "longer --time-limit" : "larger --memory-limit");
  return exit_limit;
}

std::string message_of(const Interrupted& interrupted, const Limits& limits) {
  if (interrupted.outcome() == Outcome::time_limit)
    return fmt::format("the time limit of {} s ran out", limits.time_limit);
  if (interrupted.outcome() == Outcome::memory_limit)
    return fmt::format("the memory limit of {} GB was reached",
                       static_cast<double>(limits.memory_limit) / 1e9);
  return "cancelled";
}

void write_end(const std::filesystem::path& path, Outcome outcome, const std::string& message) {
  write_json(path, {{"outcome", name(outcome)}, {"message", message}});
}

std::string not_a_count(const std::string& text) {
  errno = 0;
  static_cast<void>(std::strtoull(text.c_str(), nullptr, 0));
  return errno == 0 && text.find('-') == std::string::npos
             ? std::string()
             : std::string("a number, not negative and below 2^64, is expected");
}

void add_seed(CLI::App& command, std::uint64_t& seed, const char* help) {
  command.add_option("--seed", seed, help)->check(not_a_count)->option_text("N");
}

void add_tolerance(CLI::App& command, double& tolerance) {
  command
      .add_option(
          "--tolerance", tolerance,
          "How far corners of a facet of several polygons may lie from its plane (default 0: rounding)")
      ->check([](const std::string& text) {
        const double value = std::strtod(text.c_str(), nullptr);
        return std::isfinite(value) && value >= 0 ? std::string()
                                                  : std::string("a finite number, not negative, is expected");
      })
      ->option_text("T");
}

ReadOptions reading(const Limits& limits, const std::string& format, double tolerance) {
  ReadOptions options;
  options.tolerance = tolerance;
  static_cast<Limits&>(options) = limits;
  options.format = format;
  options.progress = goes_on;
  return options;
}

void watch_writing(WriteOptions& options, const Limits& limits) {
  static_cast<Limits&>(options) = limits;
  options.progress = goes_on;
}

bool goes_on(double) { return !cancel_requested(); }

}  // namespace holdfast::cli
