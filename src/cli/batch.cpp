// `holdfast batch`: many parts, one process each. The command is written in Python, where executors for other
// machines exist (python/holdfast/_batch.py); the program hands over to it.
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "command.h"

namespace holdfast::cli {
namespace {

namespace fs = std::filesystem;

std::string own_path() {
  std::error_code error;
  const fs::path path = fs::read_symlink("/proc/self/exe", error);
  return error ? "holdfast" : path.string();
}

std::string python() {
  if (const char* named = std::getenv("HOLDFAST_PYTHON")) return named;
  constexpr const char* system_wide = "/usr/bin/python3";  // what a package beside this program is built for
  return fs::exists(system_wide) ? system_wide : "python3";
}

// In a build folder the package is beside the program.
void find_package_beside(const fs::path& program) {
  const fs::path folder = program.parent_path() / "python";
  if (!fs::exists(folder / "holdfast" / "__init__.py")) return;
  const char* others = std::getenv("PYTHONPATH");
  const std::string path = folder.string() + (others == nullptr ? "" : std::string(":") + others);
  setenv("PYTHONPATH", path.c_str(), 1);
}

int run(const std::vector<std::string>& arguments) {
  const std::string program = own_path(), interpreter = python();
  find_package_beside(program);
  setenv("HOLDFAST_PROGRAM", program.c_str(), 1);
  const std::string start =
      "import sys\n"
      "try:\n"
      "  from holdfast.__main__ import main\n"
      "except ImportError as error:\n"
      "  sys.exit(f'holdfast: batch needs the Python package holdfast, which {sys.executable} does not have "
      "({error}); "
      "HOLDFAST_PYTHON may name an interpreter that does')\n"
      "sys.exit(main(['batch', *sys.argv[1:]]))\n";
  std::vector<std::string> words{interpreter, "-c", start};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execvp(interpreter.c_str(), pointers.data());
  throw UsageError(fmt::format("batch: {} cannot be run: {}", interpreter, std::strerror(errno)));
}

}  // namespace

void add_batch(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand(
      "batch", "Mesh many surfaces, each in its own process (batch --help; needs the Python package)");
  command->prefix_command();
  command->set_help_flag();
  command->callback(
      [command, &chosen] { chosen = [arguments = command->remaining()] { return run(arguments); }; });
}

}  // namespace holdfast::cli
