// Shared by all commands of the program: exit codes, failures, the registration of commands.
#pragma once

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

namespace holdfast::cli {

/// Exit codes (docs/command-line.md). They are part of the interface: scripts depend on them.
enum ExitCode : int {
  exit_done = 0,
  exit_internal_error = 1,
  exit_usage = 2,
  exit_file = 3,
  exit_invalid_surface = 4,
  exit_limit = 5,
  exit_check_failed = 6,
  exit_not_representable = 7,
};

/// The command line requests something that does not exist or makes no sense.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Prints a message to stderr. A closed stderr is not a failure of the command.
template <typename... Values>
void say(fmt::format_string<Values...> text, Values&&... values) {
  const std::string said = fmt::format(text, std::forward<Values>(values)...);
  static_cast<void>(std::fwrite(said.data(), 1, said.size(), stderr));
}

/// The function that `main` runs after parsing the command line; returns the exit code.
using Command = std::function<int()>;

/// Each adds its subcommand to `app`, which sets `chosen` if the user names it.
void add_mesh(CLI::App& app, Command& chosen);
void add_check(CLI::App& app, Command& chosen);
void add_diagnose(CLI::App& app, Command& chosen);
void add_delaunay(CLI::App& app, Command& chosen);
void add_untangle(CLI::App& app, Command& chosen);
void add_batch(CLI::App& app, Command& chosen);
void add_plane(CLI::App& app, Command& chosen);
void add_repair(CLI::App& app, Command& chosen);
void add_view(CLI::App& app, Command& chosen);
void add_paste(CLI::App& app, Command& chosen);
void add_tetgen(CLI::App& app, Command& chosen);
void add_convert(CLI::App& app, Command& chosen);
void add_info(CLI::App& app, Command& chosen);
void add_split(CLI::App& app, Command& chosen);
void add_join(CLI::App& app, Command& chosen);

}  // namespace holdfast::cli
