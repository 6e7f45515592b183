// The program `holdfast`: reads the command line, runs one command, and turns failures into exit codes.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "command.h"
#include "heap.h"
#include "holdfast/holdfast.h"
#include "holdfast/io.h"
#include "limits.h"
#include "signals.h"

namespace holdfast::cli {
namespace {

constexpr const char* footer =
    "Exit codes: 0 done; 1 internal error; 2 wrong usage; 3 a file cannot be read or written;\n"
    "4 the surface is not valid, or nothing to fill; 5 time or memory limit, or cancelled; 6 `check` found a "
    "violation;\n"
    "7 no positive mesh in double precision was found.";

// Adds the requested command, or all of them for help: on a small surface, adding the options of all would
// take longer than the mesh.
void add_commands(CLI::App& app, Command& chosen, std::string_view asked) {
  // clang-format off
  static constexpr std::pair<std::string_view, void (*)(CLI::App&, Command&)> kCommands[] = {
      {"mesh", add_mesh},
      {"check", add_check},
      {"diagnose", add_diagnose},
      {"repair", add_repair},
      {"paste", add_paste},
      {"delaunay", add_delaunay},
      {"untangle", add_untangle},
      {"plane", add_plane},
      {"tetgen", add_tetgen},
      {"convert", add_convert},
      {"info", add_info},
      {"view", add_view},
      {"batch", add_batch},
      {"split", add_split},
      {"join", add_join},
  };
  // clang-format on
  const auto is_asked = [&](const auto& command) { return command.first == asked; };
  const bool one = std::any_of(std::begin(kCommands), std::end(kCommands), is_asked);
  for (const auto& command : kCommands)
    if (!one || is_asked(command)) command.second(app, chosen);
}

/// A program may be started without standard streams. The next files that it opened would take their place
/// and get its messages. So each missing stream is opened in the mode that makes its use fail.
void open_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(descriptor, F_GETFD) < 0)
      static_cast<void>(open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY));
}

/// A limit ended the run while files were read or written, or in a call without an outcome. The message
/// repeats the limit as the user gave it.
int tell_interruption(const Interrupted& interrupted, const CLI::App& command) {
  const auto given = [&](const char* option) { return command.get_option(option)->as<std::string>(); };
  switch (interrupted.outcome()) {
    case Outcome::time_limit:
      return tell_limit(interrupted.outcome(), "the time limit of " + given("--time-limit") + " s ran out");
    case Outcome::memory_limit:
      return tell_limit(interrupted.outcome(),
                        "the memory limit of " + given("--memory-limit") + " GB was reached");
    default:
      return tell_limit(interrupted.outcome(), interrupted.what());
  }
}

/// An empty value, as of an unset variable, would count as no value.
void require_values(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_expected_min() == 0) continue;
    const std::vector<std::string>& given = option->results();
    if (std::find(given.begin(), given.end(), "") != given.end())
      throw UsageError(option->get_name() + ": a value is expected, and it is empty");
  }
}

int run(int count, const char* const* arguments) {
  open_standard_streams();
  fail_rather_than_die();
  prepare_heap();
  CLI::App app("Holdfast fills triangulated surfaces with tetrahedra and keeps every triangle.", "holdfast");
  app.set_version_flag("--version", std::string("holdfast ") + version());
  app.require_subcommand(1);
  app.footer(footer);

  Command chosen;
  const std::string_view first = count > 1 ? arguments[1] : "-";
  add_commands(app, chosen, first);

  // CLI11 would only report a missing command.
  const auto named = [&](const CLI::App* command) { return command->check_name(std::string(first)); };
  if (!first.starts_with('-') && app.get_subcommands(named).empty())
    throw UsageError("there is no command '" + std::string(first) + "'; `holdfast --help` lists them");
  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    // CLI11 reports help and version as errors of code 0.
    if (app.exit(error) != 0) return exit_usage;
    if (!std::cout.flush()) throw FileError("/dev/stdout", "", "cannot be written");
    return exit_done;
  }
  require_values(*app.get_subcommands().front());
  try {
    return chosen();
  } catch (const Interrupted& interrupted) {
    return tell_interruption(interrupted, *app.get_subcommands().front());
  }
}

}  // namespace
}  // namespace holdfast::cli

int main(int count, char** arguments) {
  namespace cli = holdfast::cli;
  const auto say = [](const char* what, const char* message) {
    std::fprintf(stderr, "holdfast: %s%s\n", what, message);
  };
  try {
    return cli::run(count, arguments);
  } catch (const cli::UsageError& error) {
    say("", error.what());
    return cli::exit_usage;
  } catch (const std::invalid_argument& error) {
    // The library rejected options that do not suit the surface, such as a hole outside it.
    say("", error.what());
    return cli::exit_usage;
  } catch (const holdfast::FileError& error) {
    say("", error.what());
    return cli::exit_file;
  } catch (const std::length_error& error) {
    say("", error.what());
    return cli::exit_limit;
  } catch (const std::bad_alloc&) {
    say("", "out of memory; close other programs or split the surface into parts");
    return cli::exit_limit;
  } catch (const std::exception& error) {
    say("internal error, please report it with the surface and this command line: ", error.what());
    return cli::exit_internal_error;
  }
}
