#include "surface_output.h"

#include "common_options.h"
#include "files.h"
#include "files_of_run.h"
#include "summary.h"

namespace holdfast::cli {

void add_surface_output(CLI::App& command, SurfaceOutput& output) {
  command
      .add_option(
          "-o,--output", output.output,
          "Surface to write (.off .obj .stl .ply .poly .mesh .meshb .msh .vtk .vtu), -: standard output")
      ->transform(or_standard_output)
      ->required()
      ->option_text("FILE");
}

void add_account(CLI::App& command, SurfaceOutput& output) {
  command
      .add_option("--parents", output.parents,
                  "Write a line for each triangle with the indices of those it is a part of")
      ->transform(or_standard_output)
      ->option_text("FILE");
  add_report(command, output.report, "Write all changes as JSON");
}

void add_surface_format(CLI::App& command, SurfaceOutput& output) {
  command.add_option("--format", output.format, "Format of the surface to write, instead of by ending")
      ->option_text("FORMAT");
}

bool holds_seeds(const SurfaceOutput& output, const WriteOptions& options) {
  Surface seeded;
  seeded.holes.push_back({});
  return not_held(output.output, seeded, options).empty();
}

void write_and_tell(const SurfaceOutput& output, const Surface& surface, const WriteOptions& options,
                    bool quiet) {
  write_surface(output.output, surface, options);
  if (!quiet) tell(not_held(output.output, surface, options), output.output);
}

}  // namespace holdfast::cli
