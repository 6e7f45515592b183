// `holdfast mesh`: fills surfaces with tetrahedra.
#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "command.h"
#include "common_options.h"
#include "defects.h"
#include "exact_file.h"
#include "files.h"
#include "files_of_run.h"
#include "idle_options.h"
#include "limits.h"
#include "mesh_attempts.h"
#include "mesh_input.h"
#include "mesh_options.h"
#include "mesh_output.h"
#include "mesh_refusal.h"
#include "name_options.h"
#include "page.h"
#include "paste_options.h"
#include "paste_result.h"
#include "progress.h"
#include "repair_before.h"
#include "repair_options.h"
#include "repair_result.h"
#include "report.h"
#include "signals.h"
#include "summary.h"

namespace holdfast::cli {
namespace {

class Stopwatch {
 public:
  [[nodiscard]] std::chrono::steady_clock::time_point start() const { return start_; }
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Reports how the run ended and what the user can do; returns the exit code.
int conclude(const MeshArguments& arguments, const Surface& surface, const Result& result) {
  const std::string message = result.message.empty() ? name(result.outcome) : result.message;
  switch (result.outcome) {
    case Outcome::done:
      return exit_done;
    case Outcome::invalid_input:
      print_refusal(arguments, surface, result);
      return exit_invalid_surface;
    case Outcome::time_limit:
    case Outcome::memory_limit:
    case Outcome::cancelled:
      return tell_limit(result.outcome, message);
    case Outcome::not_representable:
      if (result.report.steiner_points == 0 &&
          arguments.surfaces.size() > 1) {  // the parts could not be pasted
        say("holdfast: {}; {} was not written; another --paste=T may help\n", message,
            arguments.output.path.string());
        return exit_not_representable;
      }
      say("holdfast: {} ({} of {} added points have no position in doubles); {} was not written\n", message,
          result.report.unrounded_points, result.report.steiner_points, arguments.output.path.string());
      if (arguments.exact.empty())
        say("--exact FILE writes the mesh with exact coordinates; a surface in finer units or "
            "nearer to the origin may have a mesh in doubles\n");
      else
        say("the mesh with exact coordinates is in {}\n", arguments.exact.string());
      if (!arguments.repair)
        say("if sheets of it lie some last bits apart, as those of z = 0.3 and z = 0.1 + 0.2, --repair joins "
            "them\n");
      return exit_not_representable;
  }
  return exit_internal_error;
}

void write_result(const MeshArguments& arguments, FilesOfRun& files, const AnyTarget& target,
                  const Result& result) {
  if (result.outcome == Outcome::done)
    write_output(files, arguments.output, target, result.volume, arguments.quiet);
  if (result.outcome == Outcome::not_representable && !arguments.exact.empty())
    write_exact(arguments.exact, result);
}

void tell_the_end(const MeshArguments& arguments, const Options& options, const Result& result,
                  double seconds) {
  print_merged(result.report.input);
  if (arguments.verbose) print_details(result.report);
  print_decisions(result);
  if (result.outcome != Outcome::done) return;
  if (!arguments.names.empty()) tell_idle_names(arguments.names, nameable_in(result.volume));
  if (!result.defects.empty()) {
    print_defects(result.defects, shown_in_passing);
    if (result.defects.size() > shown_in_passing)
      say("... and {} more in the report (--report FILE.json)\n", result.defects.size() - shown_in_passing);
  }
  print_summary(arguments, options, result, seconds);
}

/// Writes the page if there is something to show: a mesh, or a surface without one.
void write_html(const MeshArguments& arguments, const Limits& limits, const Surface& surface,
                const Result& result, Json report) {
  const bool done = result.outcome == Outcome::done;
  if (!done && result.outcome != Outcome::invalid_input && result.outcome != Outcome::not_representable)
    return;
  PageOfRun page(arguments.html, limits_of_page(limits, result.outcome));
  const std::string input = arguments.surfaces.front().filename().string();
  page.set_title(input);
  if (done) page.add(arguments.output.path.filename().string(), result.volume);
  if (!done || !result.defects.empty()) page.add(input, surface, result.defects);
  page.set_verdict(done ? fmt::format("{} in {}, {}; `holdfast check` verifies that they keep the surface",
                                      counted(result.report.tetrahedra, "tetrahedron", "tetrahedra"),
                                      counted(result.report.regions, "region"),
                                      counted(result.report.steiner_points, "added point"))
                        : result.message,
                   done);
  page.set_report(std::move(report));
  page.write();
}

Json report_of(const RepairResult& result, const RepairOptions& options) {
  return to_json(result, {{"weld", options.weld},
                          {"join", options.join},
                          {"fill_holes", sides_to_json(options.fill_holes)},
                          {"union", options.unite}});
}

/// Names all files of the run before anything is read, so that an unusable one is found at once.
struct Targets {
  AnyTarget volume;
  WriteOptions repaired;
};
Targets note_files(const MeshArguments& arguments, const Options& options, FilesOfRun& files) {
  files.read_surfaces(arguments.surfaces, arguments.input_format, arguments.surface_of);
  files.read_size_field("--size-field", arguments.size_field);
  take_order(arguments.elements, files);
  Targets targets{output_target(files, "-o", arguments.output), {}};
  if (arguments.elements.order == 2 && !targets.volume.holds_volumes)
    throw UsageError(
        fmt::format("--order 2 does nothing for {}: the format holds only surfaces of first order",
                    arguments.output.path.string()));
  refuse_second_order_in_pieces(arguments.elements, arguments.output.pieces);
  targets.volume.options.threads = arguments.threads;
  watch_writing(targets.volume.options, options);
  if (!arguments.repaired.empty())
    targets.repaired = files.write_surface("--repaired", arguments.repaired, {});
  watch_writing(targets.repaired, options);
  files.write("--report", arguments.report);
  files.write("--exact", arguments.exact);
  files.write("--html", arguments.html);
  return targets;
}

/// The surface to mesh, and the smooth surface on which --curved puts mid-edge nodes.
struct GivenInput {
  MeshInput input;
  std::optional<Surface> smooth;
};
GivenInput read_all(const MeshArguments& arguments, const Names& names, Options& options,
                    ProgressView& progress) {
  progress.reading();
  const std::optional<Extent> field = read_size_field(arguments, options);
  GivenInput given{read_input(arguments, options), {}};
  Surface& surface = given.input.surface;
  if (arguments.markers_by_angle) {
    progress.finish();
    split_by_angle(arguments, surface);
  }
  merge(surface.names, names);
  given.smooth = read_curved(arguments.elements, options);
  if (!arguments.quiet) tell_of_lone_vertices(arguments, surface, progress);
  if (!surface.remarks.empty()) progress.finish();
  if (!arguments.quiet) tell(surface.remarks);
  tell_unused_sizes(arguments, surface);
  if (field) tell_field_elsewhere(arguments, *field, surface);
  require_a_size_a_vertex(arguments, options, surface);
  refuse_idle_options(arguments, options, surface);
  return given;
}

void take_repaired(const MeshArguments& arguments, const Options& options, const RepairResult& repaired,
                   MeshInput& input) {
  if (!arguments.quiet) say("repair: {}\n", summary_of(repaired));
  input.surface = repaired.surface;
  input.parts.clear();
  require_a_size_a_vertex(arguments, options, input.surface);
}

/// The report without the parts that --order 2 and --repair add.
Json report_of(const MeshArguments& arguments, const Options& options, const MeshInput& input,
               const Surface& meshed, const Result& result) {
  Json report = to_json(result, to_json(arguments));
  if (!result.defects.empty()) report["summary"] = to_json(summarise(meshed.view(), result.defects));
  report["remarks"] = to_json(input.surface.remarks);
  if (options.stop_after && *options.stop_after < Stage::classify)
    report["intermediate"] = to_json(result.intermediate);
  if (input.pasted) {
    report["parts"] = reports::parts_of(*input.pasted);
    report["shared_facets"] = input.pasted->shared_facets;
  }
  return report;
}

/// `result` has what is known if a limit ends the run.
int mesh_files(const MeshArguments& arguments, Options options, FilesOfRun& files, const Stopwatch& whole,
               Result& result) {
  const Names names = names_of(arguments.names);
  std::optional<RepairOptions> repairing = repair_options(arguments, options);
  const Targets targets = note_files(arguments, options, files);
  cancel_by_flag();

  ProgressView progress(how_to_show(arguments.quiet, arguments.verbose));
  GivenInput given = read_all(arguments, names, options, progress);
  MeshInput& input = given.input;
  const double reading = result.report.seconds["read"] = whole.seconds();

  std::optional<RepairResult> repaired;
  Surface unrepaired;  // for a further repair
  if (repairing) {
    if (arguments.exact.empty()) unrepaired = input.surface;
    repaired = repair_before(input.surface, *repairing, progress);
    if (repaired->outcome != Outcome::done) {
      write_json(arguments.report, {{"outcome", name(repaired->outcome)},
                                    {"message", repaired->message},
                                    {"repair", report_of(*repaired, *repairing)}});
      return conclude_repair(*repaired);
    }
    take_repaired(arguments, options, *repaired, input);
  }
  options.progress = std::ref(progress);
  if (!repaired) paste_parts(arguments, options, input);
  result = mesh_or_refuse(arguments, input, options);
  if (repaired && arguments.exact.empty() && !arguments.drop_unused && result.report.unrounded_points > 0 &&
      result.outcome == Outcome::not_representable)
    mesh_joined_sheets(unrepaired, options, progress, arguments.quiet, input, *repairing, *repaired, result);
  tell_defects_of_files(arguments, input, result);
  const Surface& meshed = input.pasted && arguments.paste ? input.pasted->surface : input.surface;
  const Json order = result.outcome == Outcome::done ? set_order(result.volume, arguments.elements,
                                                                 given.smooth, options, arguments.quiet)
                                                     : Json();
  const Stopwatch writing;
  progress.writing();
  if (repaired)
    write_repaired(arguments.repaired, input.surface, result.outcome, targets.repaired, arguments.quiet);
  write_result(arguments, files, targets.volume, result);
  progress.finish();
  result.report.seconds["read"] = reading;
  result.report.seconds["write"] = writing.seconds();
  result.report.seconds["total"] = whole.seconds();
  if (!arguments.report.empty() || !arguments.html.empty()) {
    Json report = report_of(arguments, options, input, meshed, result);
    report["second_order"] = order;
    if (repaired) report["repair"] = report_of(*repaired, *repairing);
    write_json(arguments.report, report);
    write_html(arguments, options, meshed, result, std::move(report));
  }
  if (!arguments.quiet) tell_the_end(arguments, options, result, whole.seconds());
  return conclude(arguments, meshed, result);
}

int run(const MeshArguments& arguments) {
  const Stopwatch whole;
  Options options = to_options(arguments);
  options.started = whole.start();  // the limit covers the whole command
  FilesOfRun files;
  Result result;  // until the end
  return work_or_report(
      options, [&] { return mesh_files(arguments, options, files, whole, result); },
      [&](Outcome outcome, const std::string& message) {
        result.outcome = outcome;
        result.message = message;
        result.report.seconds["total"] = whole.seconds();
        if (!result.report.seconds.contains("read")) result.report.seconds["read"] = whole.seconds();
        write_json(arguments.report, to_json(result, to_json(arguments)));
      });
}

}  // namespace

void add_mesh(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<MeshArguments>();
  CLI::App* command = app.add_subcommand("mesh", "Fill surfaces with tetrahedra, keeping every triangle");
  command
      ->add_option(
          "SURFACE", arguments->surfaces,
          "Surface files (.stl .off .obj .ply .3mf .amf .gltf .glb .wrl .x3d .dae .ts .gts .dxf .ac .3ds "
          ".gii .mesh "
          ".meshb .poly .smesh .node .msh .vtu .vtp .vtk, each also .gz, and any other that `convert` "
          "reads); "
          "several files are numbered one after the other; vertices with identical coordinates are one")
      ->transform(or_standard_input)
      ->required();
  command
      ->add_option(
          "-o,--output", arguments->output.path,
          "Volume file (.vtu .vtm .vtk .mesh .meshb .msh .inp .unv .bdf .su2 .mfem .vol .xdmf .med .exo "
          ".cgns .fluent .k .cdb .feb .xml .node, "
          "or OpenFOAM's constant/polyMesh), or a surface file (.stl .ply .obj .off .gts .poly) for the "
          "boundary "
          "and "
          "interfaces of the mesh, -: standard output")
      ->transform(or_standard_output)
      ->required()
      ->option_text("VOLUME");
  command->add_flag("--surface-of", arguments->surface_of,
                    "SURFACE is a volume file: mesh its surface and interfaces, without its inner vertices");
  command->add_flag(
      "--fill", arguments->fill,
      "Add no field points: only what the surface forces, and a few where an element stays flat");
  command
      ->add_flag("--repair", arguments->repair,
                 "First make the surface valid, as `repair` does; T joins vertices that are this near, as "
                 "its --weld")
      ->option_text("[=T]");
  add_repair_ways(*command, arguments->repair_ways, "With --repair: ");
  command
      ->add_option("--repaired", arguments->repaired,
                   "With --repair: write the surface that was meshed, for `check` (formats as for `repair`)")
      ->transform(or_standard_output)
      ->option_text("FILE");
  command
      ->add_option("--size", arguments->size,
                   "Field points: no edge inside much longer than this; in a region whose large triangles or "
                   "thin walls leave too few elements, a smaller size is used, at least half of it")
      ->option_text("H");
  command
      ->add_option("--gradation", arguments->gradation,
                   "Field points: growth of sizes per unit of length, away from the surface (default 0.3, up "
                   "to 0.5 on surfaces full of needles; unless this is given, points that help little there "
                   "are removed again)")
      ->option_text("G");
  command
      ->add_option(
          "--size-field", arguments->size_field,
          "Field points: sizes, or metric tensors, at the vertices of a background mesh "
          "(.mesh or .meshb with .sol or .solb, .vtu with a point array \"size\" or \"metric\", .mtr, .pos)")
      ->option_text("FILE");
  add_bounds(*command, arguments->bounds);
  command->add_flag("--no-growth", arguments->no_growth,
                    "Field points: sizes inside stay between those of the surrounding surface");
  command
      ->add_option("--quality", arguments->quality,
                   "Effort spent on the elements with field points: fast, good (default) or best")
      ->option_text("EFFORT");
  command
      ->add_option("--keep", arguments->keep,
                   "Regions to keep: auto (default), bounded, winding, box or box=MARGIN (of the largest "
                   "extent, default 0.1)")
      ->option_text("RULE");
  command
      ->add_option("--hole", arguments->holes, "Leave the region that contains this point empty (repeatable)")
      ->allow_extra_args(false)
      ->option_text("x,y,z");
  command
      ->add_option("--region", arguments->regions,
                   "Number the region that contains this point, and limit its size (repeatable)")
      ->allow_extra_args(false)
      ->option_text("x,y,z,ID[,H]");
  add_name_option(*command, arguments->names);
  add_curved(*command, arguments->elements);
  add_paste_option(*command, arguments->paste);
  add_overlap_option(*command, arguments->overlap);
  command
      ->add_option(
          "--markers-by-angle", arguments->markers_by_angle,
          "Give triangles without a marker one for each smooth patch, which ends where triangles meet at "
          "DEG degrees or more")
      ->check(CLI::Range(0.0, 180.0))
      ->option_text("DEG");
  command->add_flag("--drop-unused", arguments->drop_unused,
                    "Leave out vertices on no triangle and no segment, as those that --union leaves");
  command->add_flag("--drop-outside", arguments->drop_outside,
                    "Drop facets outside every kept region instead of refusing them");
  command
      ->add_option("--without", arguments->without,
                   "Leave out a step: 'flips' (then partition and elimination do all the work), 'optimise', "
                   "or 'points' (then none is added for flat elements) (repeatable)")
      ->allow_extra_args(false)
      ->option_text("STEP");
  command
      ->add_option_function<std::vector<std::string>>(
          "--order", [arguments](const std::vector<std::string>& words) { take_orders(*arguments, words); },
          "Two settings; give the option twice to set both. 1 (default) or 2: order of the elements, 2 with "
          "mid-edge nodes. random (default), given or halving: the order in which missing constraints are "
          "cut in, where halving takes the middle one, then those in the middle of both halves")
      ->allow_extra_args(false)
      ->option_text("1|2|random|given|halving");
  add_seed(*command, arguments->seed);
  add_threads(*command, arguments->threads);
  command->add_option("--time-limit", arguments->time_limit, "Give up after this many seconds (exit 5)")
      ->option_text("S");
  command->add_option("--memory-limit", arguments->memory_limit, "Give up above this much memory (exit 5)")
      ->option_text("GB");
  add_report(*command, arguments->report, "Write counts, times and quality as JSON");
  command
      ->add_option("--exact", arguments->exact,
                   "If no positive mesh in doubles is found (exit 7), write the exact one as JSON lines")
      ->transform(or_standard_output)
      ->option_text("FILE");
  command
      ->add_option("--stop-after", arguments->stop_after,
                   "Write the state after validate, delaunay, flips, partition, eliminate, classify, "
                   "suppress or field_points")
      ->option_text("STAGE");
  add_html_option(*command, arguments->html);
  add_volume_format(*command, arguments->output.format);
  command->add_flag("--each-region", arguments->output.each_region, each_region_help);
  command->add_flag("--no-interfaces", arguments->output.no_interfaces, no_interfaces_help);
  add_tolerance(*command, arguments->tolerance);
  add_write_options(*command, arguments->output.writing);
  add_partition(*command, arguments->output.pieces);
  add_input_format(*command, arguments->input_format, "Surface format");
  CLI::Option* quiet = add_quiet(*command, arguments->quiet);
  command->add_flag("-v,--verbose", arguments->verbose, "Report every stage")->excludes(quiet);
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace holdfast::cli
