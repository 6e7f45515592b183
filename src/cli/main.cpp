// The program `holdfast`: reads the command line, runs one command, turns failures into exit codes.
#include <fmt/core.h>

#include <new>

#include "command.h"
#include "holdfast/holdfast.h"
#include "holdfast/io.h"

namespace {

using namespace holdfast::cli;

constexpr const char* footer =
    "Exit codes: 0 done; 1 internal error; 2 wrong usage; 3 a file cannot be read or written;\n"
    "4 the surface is not valid; 5 time or memory limit, or cancelled; 6 `check` found a violation;\n"
    "7 no positive mesh in double precision was found.";

int run(const Command& command) {
  try {
    return command();
  } catch (const UsageError& error) {
    fmt::print(stderr, "holdfast: {}\n", error.what());
    return exit_usage;
  } catch (const holdfast::FileError& error) {
    fmt::print(stderr, "holdfast: {}\n", error.what());
    return exit_file;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "holdfast: out of memory; close other programs or split the surface into parts\n");
    return exit_limit;
  } catch (const std::exception& error) {
    fmt::print(stderr,
               "holdfast: internal error: {}\nPlease report it with the surface and this command line.\n",
               error.what());
    return exit_internal_error;
  }
}

}  // namespace

int main(int count, char** arguments) {
  CLI::App app("Holdfast fills triangulated surfaces with tetrahedra and keeps every triangle.", "holdfast");
  app.set_version_flag("--version", std::string("holdfast ") + holdfast::version());
  app.require_subcommand(1);
  app.footer(footer);

  Command chosen;
  add_mesh(app, chosen);
  add_check(app, chosen);
  add_diagnose(app, chosen);
  add_delaunay(app, chosen);
  // CLI11 would only say that a command is missing.
  const std::string first = count > 1 ? arguments[1] : "-";
  if (!first.starts_with('-') &&
      app.get_subcommands([&](const CLI::App* c) { return c->check_name(first); }).empty()) {
    fmt::print(stderr, "holdfast: there is no command '{}'; `holdfast --help` lists them\n", first);
    return exit_usage;
  }
  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    // Help and version are "errors" of code 0 here.
    return app.exit(error) == 0 ? exit_done : exit_usage;
  }
  return run(chosen);
}
