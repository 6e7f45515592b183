// `holdfast view`: makes a page that shows surfaces and volumes in a browser.
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "command.h"
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

/// A file is a volume if its format can hold tetrahedra and it has some.
struct Shape {
  std::filesystem::path path;
  Volume volume;
  Surface surface;
  bool is_volume = false;
};

bool may_be_a_volume(std::filesystem::path path, const std::string& format) {
  if (path.extension() == ".gz") path.replace_extension();
  std::string kind = format.empty() ? path.extension().string() : format;
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (!kind.empty() && kind.front() != '.') kind.insert(kind.begin(), '.');
  const std::vector<std::string> known = volume_formats();
  return std::find(known.begin(), known.end(), kind) != known.end();
}

/// A pipe can be read only once; its format decides how.
Shape read_shape(const std::filesystem::path& path, const ReadOptions& options, bool quiet) {
  Shape shape{path, {}, {}};
  std::vector<Remark> remarks;
  const bool may_be = may_be_a_volume(path, options.format);
  std::error_code ignored;
  const bool once = descriptor_of(path).has_value() || !std::filesystem::is_regular_file(path, ignored);
  // A .node without its .ele is a list of points.
  const bool alone = path.extension() == ".node" &&
                     !std::filesystem::exists(std::filesystem::path(path).replace_extension(".ele"), ignored);
  if (may_be && !alone) {
    shape.volume = read_volume(path, options, &remarks);
    shape.is_volume = once || !shape.volume.tetrahedra.empty();
  }
  if (!shape.is_volume) {
    shape.volume = {};
    shape.surface = read_surface(path, options);
    remarks = shape.surface.remarks;
  }
  if (!quiet) tell(remarks, path);
  return shape;
}

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
  for (const auto& path : arguments.files) {
    if (may_be_a_volume(path, arguments.input_format))
      files.read_volume(path, arguments.input_format);
    else
      files.read_surfaces({path}, arguments.input_format);
  }
  files.write("-o", arguments.output);
  cancel_by_flag();
  std::vector<Shape> shapes;
  for (const auto& path : arguments.files)
    shapes.push_back(
        read_shape(path, reading(limits, arguments.input_format, arguments.tolerance), arguments.quiet));

  const bool is_temporary = arguments.output.empty();
  const std::filesystem::path output = is_temporary ? temporary_page() : arguments.output;
  PageOfRun page(output, limits);
  std::string title;
  for (const Shape& shape : shapes) {
    const std::string name = shape.path.filename().string();
    title += (title.empty() ? "" : ", ") + name;
    if (shape.is_volume)
      page.add(name, shape.volume);
    else
      page.add(name, shape.surface);
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
  command->add_option("--input-format", arguments->input_format, "Format of the files, instead of by ending")
      ->option_text("FORMAT");
  add_tolerance(*command, arguments->tolerance);
  add_limits(*command, arguments->limits);
  command->add_flag("-q,--quiet", arguments->quiet, "Say nothing unless something is wrong");
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace holdfast::cli
