// `holdfast check`: whether a volume keeps the promise for a surface.
#include "holdfast/check.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "check_folder.h"
#include "check_repaired.h"
#include "command.h"
#include "common_options.h"
#include "files.h"
#include "files_of_run.h"
#include "holdfast/patches.h"
#include "limits.h"
#include "page.h"
#include "report.h"
#include "signals.h"
#include "unused_vertices.h"

namespace holdfast::cli {
namespace {

struct CheckArguments {
  std::vector<std::filesystem::path> files;  // the surfaces, then the volume
  std::filesystem::path report, parents, verdict, html;
  std::string input_format, format;
  double tolerance = 0;
  std::optional<double> markers_by_angle;
  CheckOptions options;
  LimitArguments limits;
  bool repaired = false, surface_of = false, unused_dropped = false, quiet = false;
};

std::string listing_of(const CheckResult& result) {
  std::string text;
  for (const Rule& rule : result.rules)
    text += fmt::format("{}  {}{}{}\n", rule.holds ? "holds " : "BROKEN", rule.name,
                        rule.detail.empty() ? "" : ": ", rule.detail);
  return text;
}

void write_html(const CheckArguments& arguments, const Limits& limits, const Surface& surface,
                const Volume& volume, const CheckResult& result) {
  PageOfRun page(arguments.html, limits);
  const std::string name = arguments.files.back().filename().string();
  page.set_title(name);
  page.add(name, volume);
  page.add(arguments.files.front().filename().string(), surface);
  page.set_verdict(
      name + (result.holds() ? " keeps the surface: every rule holds" : " does not keep the surface"),
      result.holds());
  page.set_rules(result.rules);
  page.set_report(to_json(result));
  page.write();
}

/// Whether a path is a folder, or looks like one that does not exist.
bool is_meant_as_folder(const std::filesystem::path& file) {
  return std::filesystem::is_directory(file) || (!std::filesystem::exists(file) && !file.has_extension());
}

int run_on_folder(const CheckArguments& arguments, const CheckOptions& options) {
  if (options.outside_dropped || options.box || arguments.surface_of || arguments.markers_by_angle ||
      arguments.unused_dropped || !arguments.input_format.empty() || !arguments.format.empty() ||
      !arguments.html.empty())
    throw UsageError(
        "check: --outside-dropped, --unused-dropped, --box, --surface-of, --markers-by-angle, --format, "
        "--input-format and --html do nothing for a folder, whose manifest tells all that");
  return check_folder({arguments.files[0], arguments.report, options, arguments.quiet});
}

int run_repaired(const CheckArguments& arguments) {
  if (arguments.options.outside_dropped || arguments.options.box || arguments.surface_of ||
      arguments.markers_by_angle || arguments.unused_dropped || !arguments.html.empty())
    throw UsageError(
        "check: --outside-dropped, --unused-dropped, --box, --surface-of, --markers-by-angle and --html are "
        "about volumes, and "
        "--repaired is about a surface");
  RepairedFiles files;
  files.inputs.assign(arguments.files.begin(), arguments.files.end() - 1);
  files.output = arguments.files.back();
  files.parents = arguments.parents;
  files.report = arguments.report;
  files.verdict = arguments.verdict;
  files.input_format = arguments.input_format;
  files.format = arguments.format;
  return check_repaired_files(files, limits_of(arguments.limits), arguments.quiet);
}

/// Whether all that is broken is that something lies outside every tetrahedron.
bool holds_but_outside(const Complex& surface, const Volume& volume, CheckOptions options,
                       const CheckResult& result) {
  const auto may_be_outside = [](const Rule& rule) {
    return rule.holds || rule.kind == RuleKind::no_vertex_unused || rule.kind == RuleKind::nothing_dropped;
  };
  if (options.outside_dropped || !std::all_of(result.rules.begin(), result.rules.end(), may_be_outside))
    return false;
  options.outside_dropped = true;
  return check(surface, volume, options).holds();
}

int check_files(const CheckArguments& arguments, const CheckOptions& options,
                const std::vector<std::filesystem::path>& surfaces, const FilesOfRun& files) {
  const std::filesystem::path& volume_path = arguments.files.back();
  Surface surface = read_surfaces(surfaces, reading(options, arguments.input_format, arguments.tolerance),
                                  arguments.surface_of);
  if (arguments.markers_by_angle && markers_by_angle(surface, *arguments.markers_by_angle) == 0)
    throw UsageError("--markers-by-angle does nothing: every triangle of the surface has a marker already");
  if (!arguments.quiet) tell(surface.remarks);
  if (arguments.unused_dropped) surface.vertices = without_unused(surface);
  const Volume volume = read_volume(volume_path, reading(options, arguments.format));

  const CheckResult result = check(surface.view(), volume, options);
  if (!arguments.quiet) files.list(listing_of(result));
  write_json(arguments.report, to_json(result));
  write_html(arguments, options, surface, volume, result);
  if (result.holds()) return exit_done;
  say("holdfast: {} does not keep the surface; the rules marked BROKEN say where\n", volume_path.string());
  if (holds_but_outside(surface.view(), volume, options, result))
    say("holdfast: it keeps all but what lies outside every tetrahedron, as meshes of --drop-outside and "
        "--union do; --outside-dropped accepts that\n");
  return exit_check_failed;
}

int run(const CheckArguments& arguments) {
  if (arguments.repaired && arguments.files.size() >= 2) return run_repaired(arguments);
  if (!arguments.parents.empty() || !arguments.verdict.empty())
    throw UsageError("check: --parents and --verdict go with --repaired");
  CheckOptions options = arguments.options;
  static_cast<Limits&>(options) = limits_of(arguments.limits);
  if (arguments.files.size() == 1 && is_meant_as_folder(arguments.files[0]))
    return run_on_folder(arguments, options);
  if (arguments.files.size() < 2)
    throw UsageError(
        "check: a surface and a volume are expected, as in `holdfast check part.stl part.vtu`, "
        "or, with --repaired, surfaces and what `holdfast repair` made of them");
  const std::vector<std::filesystem::path> surfaces(arguments.files.begin(), arguments.files.end() - 1);
  FilesOfRun files;
  files.read_surfaces(surfaces, arguments.input_format, arguments.surface_of);
  files.read_volume(arguments.files.back(), arguments.format);
  files.write("--report", arguments.report);
  files.write("--html", arguments.html);
  cancel_by_flag();
  return work_or_write_end(options, [&] { return check_files(arguments, options, surfaces, files); },
                           {arguments.report});
}

}  // namespace

void add_check(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand(
      "check", "Verify exactly that a volume keeps a surface, or a repaired surface its input");
  command
      ->add_option(
          "SURFACE VOLUME", arguments->files,
          "The surfaces that were meshed, then the volume (.vtu .pvtu .pvd .vtm .vtk .mesh .meshb "
          ".msh .inp .unv "
          ".bdf .su2 .mfem .vol .xdmf .med .exo .cgns .fluent .k .cdb .feb .xml .case .cas .avs .node, or "
          "OpenFOAM's "
          "constant/polyMesh); "
          "or the folder of a "
          "split surface; with --repaired the surfaces that were repaired, then the result")
      ->transform(or_standard_input)
      ->required();
  command->add_flag("--outside-dropped", arguments->options.outside_dropped,
                    "Accept missing facets that lie outside every tetrahedron (mesh --drop-outside)");
  command->add_flag("--unused-dropped", arguments->unused_dropped,
                    "Vertices on no triangle and no segment are not in the mesh (mesh --drop-unused)");
  command->add_flag("--box", arguments->options.box,
                    "The mesh extends to an enclosing box (mesh --keep box)");
  command->add_flag("--surface-of", arguments->surface_of,
                    "SURFACE is a volume file, whose surface and interfaces were meshed (mesh --surface-of)");
  command
      ->add_option(
          "--markers-by-angle", arguments->markers_by_angle,
          "Triangles without a marker were given one for each smooth patch (mesh --markers-by-angle)")
      ->check(CLI::Range(0.0, 180.0))
      ->option_text("DEG");
  command->add_flag("--repaired", arguments->repaired,
                    "The last file is what `repair` made of the others, as --parents and --report claim");
  command
      ->add_option("--parents", arguments->parents, "With --repaired: the file that `repair --parents` wrote")
      ->transform(or_standard_input)
      ->option_text("FILE");
  command->add_option("--verdict", arguments->verdict, "With --repaired: write the rules as JSON")
      ->transform(or_standard_output)
      ->option_text("FILE.json");
  command->add_option("--format", arguments->format, "Format of the last file, instead of by ending")
      ->option_text("FORMAT");
  add_tolerance(*command, arguments->tolerance);
  add_input_format(*command, arguments->input_format, "Surface format");
  add_report(*command, arguments->report,
             "Write the rules as JSON; with --repaired: read the report that `repair --report` wrote");
  add_html_option(*command, arguments->html);
  add_limits(*command, arguments->limits);
  command->add_flag("-q,--quiet", arguments->quiet, "Only the exit code and failures");
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace holdfast::cli
