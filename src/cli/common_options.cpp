#include "common_options.h"

#include "files_of_run.h"

namespace holdfast::cli {

void add_threads(CLI::App& command, unsigned& threads) {
  command
      .add_option("--threads", threads,
                  "Threads, 0: all available (default 1); the result does not depend on them")
      ->check(CLI::Range(0u, 4096u))
      ->option_text("N");
}

void add_report(CLI::App& command, std::filesystem::path& report, const char* help) {
  command.add_option("--report", report, help)->transform(or_standard_output)->option_text("FILE.json");
}

void add_volume_output(CLI::App& command, std::filesystem::path& output) {
  command
      .add_option("-o,--output", output,
                  "Volume file (.vtu .vtm .vtk .mesh .meshb .msh .inp .unv .bdf .su2 .mfem .vol .xdmf .med "
                  ".exo .cgns .fluent .k .cdb .feb .xml .node, "
                  "or OpenFOAM's constant/polyMesh), -: standard output")
      ->transform(or_standard_output)
      ->required()
      ->option_text("VOLUME");
}

void add_volume_format(CLI::App& command, std::string& format) {
  command
      .add_option(
          "--format", format,
          "Volume format, instead of by ending; msh2 is .msh 2.2, fluent Fluent's .msh, openfoam a case")
      ->option_text("FORMAT");
}

void add_input_format(CLI::App& command, std::string& input_format, const std::string& format) {
  command.add_option("--input-format", input_format, format + ", instead of by ending")
      ->option_text("FORMAT");
}

CLI::Option* add_quiet(CLI::App& command, bool& quiet) {
  return command.add_flag("-q,--quiet", quiet, "Say nothing unless something is wrong");
}

}  // namespace holdfast::cli
