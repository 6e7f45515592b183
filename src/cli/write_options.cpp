#include "write_options.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "command.h"

namespace holdfast::cli {
namespace {

struct Choice {
  const char* option;
  bool WriteArguments::*given;
  bool WriteOptions::*set;
  std::vector<std::string> formats;  ///< those in which it has an effect
};

std::vector<Choice> choices() {
  return {{"--binary", &WriteArguments::binary, &WriteOptions::binary, {".msh"}},
          {"--gzip", &WriteArguments::gzip, &WriteOptions::gzip, {".openfoam"}},
          {"--one-file", &WriteArguments::one_file, &WriteOptions::one_file, {".vtu", ".xdmf"}},
          {"--shells", &WriteArguments::shells, &WriteOptions::shells, {".inp"}}};
}

}  // namespace

void add_write_options(CLI::App& command, WriteArguments& arguments) {
  command.add_flag("--binary", arguments.binary, ".msh: write numbers as bytes");
  command.add_flag(
      "--one-file", arguments.one_file,
      ".vtu, .xdmf: write triangles and segments into the same file, not into NAME_surface beside it");
  command.add_flag("--gzip", arguments.gzip, "OpenFOAM: compress the files");
  command.add_flag("--shells", arguments.shells, ".inp: write triangles as shell elements, too");
}

void apply(const WriteArguments& arguments, VolumeTarget& target) {
  const std::string kind = format_of(target);
  for (const Choice& choice : choices()) {
    if (!(arguments.*choice.given)) continue;
    if (std::find(choice.formats.begin(), choice.formats.end(), kind) == choice.formats.end())
      throw UsageError(fmt::format("{} does nothing for {}: it is for {}", choice.option, kind,
                                   fmt::join(choice.formats, ", ")));
    target.options.*choice.set = true;
  }
}

}  // namespace holdfast::cli
