// `holdfast view`: makes a page that shows surfaces and volumes in a browser.
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cstdlib>
#include <memory>

#include "any_mesh.h"
#include "command.h"
#include "common_options.h"
#include "files.h"
#include "files_of_run.h"
#include "limits.h"
#include "page.h"
#include "signals.h"

namespace holdfast::cli {
namespace {

struct ViewArguments {
  std::vector<std::filesystem::path> files;
  std::filesystem::path output;
  std::string input_format;
  LimitArguments limits;
  double tolerance = 0;
  bool quiet = false;
};

/// A unique name for the page if there is no -o.
std::filesystem::path temporary_page() {
  std::string name = (std::filesystem::temp_directory_path() / "holdfast-XXXXXX.html").string();
  const int file = mkstemps(name.data(), 5);
  if (file < 0) throw FileError(name, "", "cannot be created; name a page by -o");
  close(file);
  return name;
}

/// Opens the page in the desktop's browser; returns false if there is none.
bool open_in_browser(const std::filesystem::path& page) {
  std::string program = "xdg-open", path = page.string();
  char* arguments[] = {program.data(), path.data(), nullptr};
  pid_t child = 0;
  if (posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments, environ) != 0) return false;
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

int run(const ViewArguments& arguments) {
  const Limits limits = limits_of(arguments.limits);
  FilesOfRun files;
  for (const auto& path : arguments.files) read_any(files, path, arguments.input_format);
  files.write("-o", arguments.output);
  cancel_by_flag();
  const ReadOptions options = reading(limits, arguments.input_format, arguments.tolerance);
  std::vector<AnyMesh> meshes;
  for (const auto& path : arguments.files) {
    meshes.push_back(read_any(path, options));
    if (!arguments.quiet) tell(meshes.back().remarks, path);
  }

  const bool is_temporary = arguments.output.empty();
  const std::filesystem::path output = is_temporary ? temporary_page() : arguments.output;
  PageOfRun page(output, limits);
  std::string title;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const std::string name = arguments.files[i].filename().string();
    title += (title.empty() ? "" : ", ") + name;
    if (meshes[i].is_volume)
      page.add(name, meshes[i].volume);
    else
      page.add(name, meshes[i].surface);
  }
  page.set_title(title);
  try {
    page.write();
  } catch (...) {
    std::error_code ignored;
    if (is_temporary) std::filesystem::remove(output, ignored);
    throw;
  }
  if (is_temporary && !open_in_browser(output) && !arguments.quiet)
    say("no browser was found; open {}\n", output.string());
  if (is_temporary) files.list(output.string() + "\n");
  return exit_done;
}

}  // namespace

void add_view(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<ViewArguments>();
  CLI::App* command = app.add_subcommand("view", "Show surfaces and volumes: a page for a browser, one file");
  command
      ->add_option("FILE", arguments->files,
                   "Surface and volume files, of any format that `mesh` or `check` reads; the page shows one "
                   "at a time")
      ->transform(or_standard_input)
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "The page to write, -: standard output; without it a temporary one is opened in a browser")
      ->transform(or_standard_output)
      ->option_text("PAGE.html");
  add_input_format(*command, arguments->input_format, "Format of the files");
  add_tolerance(*command, arguments->tolerance);
  add_limits(*command, arguments->limits);
  add_quiet(*command, arguments->quiet);
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace holdfast::cli
