// `holdfast plane`: triangulates points and segments in the plane.
#include "holdfast/plane.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <optional>
#include <span>

#include "any_mesh.h"
#include "command.h"
#include "common_options.h"
#include "defects.h"
#include "files.h"
#include "files_of_run.h"
#include "limits.h"
#include "name_options.h"
#include "named.h"
#include "number_list.h"
#include "plane_repair.h"
#include "plane_report.h"
#include "repair_options.h"
#include "report.h"
#include "signals.h"
#include "summary.h"

namespace holdfast::cli {
namespace {

struct PlaneArguments {
  std::filesystem::path input, output, report;
  std::string input_format, format, method = "swaps", ears, stop_after, order;
  std::vector<std::string> names, holes, regions;
  LimitArguments limits;
  std::uint64_t seed = 1;
  double tolerance = 0;
  std::optional<double> size, angle, arcs;
  std::optional<std::string> repair;  ///< the tolerance, or "true"
  std::size_t max_points = PlaneOptions{}.max_points;
  bool partition_first = false, delaunay = false, hull = false, keep_boundary = false, quiet = false;
};

void set_refinement(const PlaneArguments& arguments, PlaneOptions& options) {
  if (arguments.size && !(*arguments.size > 0 && std::isfinite(*arguments.size)))
    throw UsageError(
        fmt::format("--size {}: a positive and finite length is expected; without the option edges are as "
                    "long as they are",
                    *arguments.size));
  constexpr double most_angle = 34;
  if (arguments.angle && !(*arguments.angle >= 0 && *arguments.angle <= most_angle))
    throw UsageError(
        fmt::format("--angle {}: a number of degrees from 0 to 34 is expected; up to 26.45 every input ends",
                    *arguments.angle));
  options.size = arguments.size.value_or(0);
  options.angle = arguments.angle;
  if (arguments.arcs && !(*arguments.arcs >= 0.1 && *arguments.arcs <= 120))
    throw UsageError(
        fmt::format("--arcs {}: a number of degrees from 0.1 to 120 is expected", *arguments.arcs));
  options.keep_boundary = arguments.keep_boundary;
  options.max_points = arguments.max_points;
  const bool refines = arguments.size || arguments.angle;
  if (!refines && arguments.keep_boundary)
    throw UsageError("--keep-boundary does nothing without --size or --angle: no point is added");
  if (!refines && arguments.max_points != PlaneOptions{}.max_points)
    throw UsageError("--max-points does nothing without --size or --angle: no point is added");
  if (refines && options.stop_after)
    throw UsageError(fmt::format("--stop-after {}: --size and --angle come after it", arguments.stop_after));
}

/// "delaunay", "partition", or "swap=K" to stop after K swaps.
void set_stage(const std::string& text, PlaneOptions& options) {
  const std::string stage = text.substr(0, text.find('='));
  options.stop_after = named<PlaneStage>("--stop-after", stage);
  if (options.stop_after != PlaneStage::swap && stage == text) return;
  const char* const first = text.data() + std::min(text.size(), stage.size() + 1);
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(first, last, options.stop_after_swaps);
  if (options.stop_after != PlaneStage::swap || first == last || end != last || error != std::errc())
    throw UsageError(
        fmt::format("--stop-after {}: the stages are delaunay, partition and swap=K, after K swaps", text));
}

PlaneOptions to_options(const PlaneArguments& arguments) {
  PlaneOptions options;
  static_cast<Limits&>(options) = limits_of(arguments.limits);
  options.method = named<PlaneMethod>("--method", arguments.method);
  if (!arguments.stop_after.empty()) {
    set_stage(arguments.stop_after, options);
    if (options.method == PlaneMethod::ears ||
        (options.stop_after == PlaneStage::swap && options.method != PlaneMethod::swaps) ||
        (options.stop_after == PlaneStage::partition && options.method != PlaneMethod::partition))
      throw UsageError(fmt::format("--stop-after {}: the method {} has no such stage", arguments.stop_after,
                                   arguments.method));
  }
  if (!arguments.ears.empty()) {
    if (options.method != PlaneMethod::ears)
      throw UsageError(fmt::format("--ears {}: give --method ears, too", arguments.ears));
    options.ears = named<PlaneEars>("--ears", arguments.ears);
  }
  if (arguments.partition_first && options.method != PlaneMethod::partition)
    throw UsageError("--partition-first: give --method partition, too");
  if (!arguments.order.empty()) {
    if (options.method == PlaneMethod::ears)
      throw UsageError("--order: the method ears lays no segments one by one");
    options.order = named<LayingOrder>("--order", arguments.order);
  }
  if (options.stop_after && !(arguments.holes.empty() && arguments.regions.empty()))
    throw UsageError(fmt::format("--stop-after {}: --hole and --region come after it", arguments.stop_after));
  if (options.stop_after && arguments.delaunay)
    throw UsageError(fmt::format("--stop-after {}: --delaunay comes after it", arguments.stop_after));
  options.partition_first = arguments.partition_first;
  options.delaunay = arguments.delaunay;
  options.hull = arguments.hull;
  set_refinement(arguments, options);
  options.seed = arguments.seed;
  options.progress = goes_on;
  return options;
}

Json report_of(const PlaneArguments& arguments, const PlaneResult& result,
               const std::optional<PlaneRepairReport>& repaired) {
  return reports::to_json(result,
                          {{"input", arguments.input.string()},
                           {"output", arguments.output.string()},
                           {"method", arguments.method},
                           {"ears", arguments.ears},
                           {"partition_first", arguments.partition_first},
                           {"delaunay", arguments.delaunay},
                           {"hull", arguments.hull},
                           {"size", arguments.size.value_or(0)},
                           {"angle", arguments.angle ? Json(*arguments.angle) : Json()},
                           {"tolerance", arguments.tolerance},
                           {"arcs", arguments.arcs.value_or(0)},
                           {"repair", arguments.repair ? Json(*arguments.repair) : Json(nullptr)},
                           {"holes", arguments.holes},
                           {"regions", arguments.regions},
                           {"keep_boundary", arguments.keep_boundary},
                           {"max_points", arguments.max_points},
                           {"stop_after", arguments.stop_after},
                           {"order", arguments.order},
                           {"seed", arguments.seed},
                           {"time_limit", arguments.limits.time_limit.value_or(0)},
                           {"memory_limit", arguments.limits.memory_limit.value_or(0)}},
                          !arguments.stop_after.empty(), repaired);
}

/// Reports what refinement did and what is left.
void tell_of_refinement(const PlaneArguments& arguments, const PlaneReport& report) {
  if (!arguments.size && !arguments.angle) return;
  say("added: {} inside, {} on segments; the least angle is {:.2f} degrees\n",
      counted(report.field_points, "point"), report.segment_points, report.least_angle);
  if (report.small_angles > 0)
    say("{} a smaller angle than asked for at, or across from, a small angle of the input\n",
        counted(report.small_angles, "triangle has", "triangles have"));
  if (report.small_angles_left > 0)
    say("{} a smaller angle than asked for\n",
        counted(report.small_angles_left, "other triangle has", "other triangles have"));
  if (report.large_left > 0)
    say("{} larger than asked for\n", counted(report.large_left, "triangle is", "triangles are"));
  if (report.capped)
    say("no more than {} added: allow more by --max-points, or ask for less\n",
        counted(arguments.max_points, "point is", "points are"));
}

/// Reports how the run ended and what the user can do; returns the exit code.
int conclude(const PlaneArguments& arguments, const PlaneResult& result) {
  if (result.outcome == Outcome::done) {
    if (!arguments.quiet)
      say("{}: {}, {} in {}, {:.2f} s\n", arguments.output.string(),
          counted(reports::points_of(result.mesh), "point"), counted(result.report.triangles, "triangle"),
          counted(result.report.regions, "region"), result.report.seconds.at("total"));
    if (!arguments.quiet) tell_of_refinement(arguments, result.report);
    return exit_done;
  }
  say("holdfast: {}: {}; nothing was written\n", arguments.input.string(), result.message);
  if (result.outcome == Outcome::not_representable) return exit_not_representable;
  if (result.outcome != Outcome::invalid_input) return exit_limit;
  for (const Defect& defect :
       std::span(result.defects).first(std::min(shown_in_passing, result.defects.size())))
    say("{}: {}\n", name(defect.kind), defect.message);
  if (result.defects.size() > shown_in_passing)
    say("... and {} more; --report FILE.json lists them\n", result.defects.size() - shown_in_passing);
  if (are_repairable(result.defects))
    say("--repair cuts segments where they meet; --repair=T also joins points within T of segments and of "
        "each other\n");
  return exit_invalid_surface;
}

/// Names the files of a run, so that none is overwritten.
WriteOptions target_of(FilesOfRun& files, const PlaneArguments& arguments) {
  files.read_points(arguments.input, arguments.input_format);
  const std::string format = volume_format_of(arguments.output, arguments.format);
  const std::vector<std::string> known = plane_formats();
  if (format != ".msh2" && !is_one_of(known, format))
    throw UsageError(
        fmt::format("{}: '{}' is no format of triangles; use {} as the file's ending or by --format",
                    arguments.output.string(), format, fmt::join(known, " ")));
  WriteOptions writing;
  // A .vtu of triangles is one file, and so are .node and .ele without a .face.
  if (is_one_of({".vtu", ".node", ".ele"}, format)) {
    writing.format = format;
    for (const std::filesystem::path& path : files_of_plane(arguments.output, format))
      files.write("-o", path);
  } else {
    writing = write_any(files, "-o", arguments.output, format).options;
  }
  files.write("--report", arguments.report);
  return writing;
}

/// Gives the mesh the names of --name. Regions are markers in formats without regions of triangles, so that
/// either word names them.
void name_parts(const PlaneArguments& arguments, PlaneMesh& mesh) {
  merge(mesh.names, names_of(arguments.names));
  if (arguments.quiet) return;
  Nameable there = nameable_in(surface_of(mesh));
  there.regions = there.facets;
  there.regions_are_known = true;
  tell_idle_names(arguments.names, there);
}

/// Says which points of options, that follow those of the file, do nothing.
void tell_idle_points(const PlaneArguments& arguments, const PlanesInSpace& planes,
                      const PlaneReport& report) {
  const auto tell = [](const std::vector<std::string>& texts, const char* option, std::size_t all,
                       const std::vector<Index>& idle, const char* why) {
    for (const Index i : idle)
      if (i + texts.size() >= all)
        say("holdfast: {} {} does nothing: {}\n", option, texts[i + texts.size() - all], why);
  };
  if (planes.parts.size() != 1 || !arguments.stop_after.empty()) return;
  const Plane& plane = planes.parts[0].plane;
  tell(arguments.holes, "--hole", plane.holes.size(), report.idle_holes, "the point is in no region");
  tell(arguments.regions, "--region", plane.regions.size(), report.idle_seeds,
       "the point is in no region that is kept, or in one that a later --region numbers");
}

/// A point of --hole or --region, as the plane of the file is seen. Two coordinates do for planes that are
/// seen along z.
PlanePoint seen_in(const PlanesInSpace& planes, const std::string& option, const std::vector<double>& x,
                   std::size_t coordinates) {
  if (planes.parts.size() != 1)
    throw UsageError(option + ": the file has polygons in several planes, and each is filled as it is");
  const std::size_t axis = planes.points.empty() ? 2 : planes.parts[0].axis;
  if (coordinates == 2 && axis != 2)
    throw UsageError(option +
                     ": three coordinates are expected, as the plane is seen along another axis than z");
  return {x[(axis + 1) % 3 % coordinates], x[(axis + 2) % 3 % coordinates]};
}

void add_holes_and_regions(const PlaneArguments& arguments, PlanesInSpace& planes) {
  const auto commas = [](const std::string& text) { return std::count(text.begin(), text.end(), ','); };
  for (const std::string& hole : arguments.holes) {
    const std::size_t coordinates = commas(hole) == 2 ? 3 : 2;
    const std::vector<double> x = numbers("--hole ", hole, coordinates, "two or three numbers x,y,z are");
    const PlanePoint where = seen_in(planes, "--hole " + hole, x, coordinates);
    planes.parts[0].plane.holes.push_back(where);
  }
  for (const std::string& region : arguments.regions) {
    const std::size_t coordinates = commas(region) == 3 ? 3 : 2;
    const std::vector<double> x =
        numbers("--region ", region, coordinates + 1, "two or three numbers and an id x,y,z,ID are");
    const PlanePoint where = seen_in(planes, "--region " + region, x, coordinates);
    planes.parts[0].plane.regions.push_back({where, region_id_of(region, x[coordinates])});
  }
}

PlaneResult solve(const PlanesInSpace& planes, const PlaneOptions& options) {
  try {
    return triangulate(planes, options);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

bool is_drawing(const PlaneArguments& arguments) {
  const std::filesystem::path& path = arguments.input;
  const bool packed = path.extension() == ".gz";
  return volume_format_of(packed ? path.parent_path() / path.stem() : path, arguments.input_format) == ".dxf";
}

int run(const PlaneArguments& arguments) {
  const PlaneOptions options = to_options(arguments);
  if (arguments.arcs && !is_drawing(arguments))
    throw UsageError("--arcs does nothing without a .dxf: no other file has arcs");
  std::optional<double> weld;
  if (arguments.repair) weld = weld_of(*arguments.repair);
  FilesOfRun files;
  WriteOptions writing = target_of(files, arguments);
  cancel_by_flag();
  watch_writing(writing, options);
  PlaneResult result;
  std::optional<PlaneRepairReport> repaired;
  work_or_report(
      options,
      [&] {
        ReadOptions how = reading(options, arguments.input_format, arguments.tolerance);
        how.arc_step = arguments.arcs.value_or(0);
        PlanesInSpace planes = read_planes(arguments.input, how);
        if (!arguments.quiet) tell(planes.remarks, arguments.input);
        if (weld) {
          PlanesRepair repair = repair_planes(planes, *weld, options);
          repaired = repair.report;
          result.outcome = repair.outcome;
          result.message = repair.message;
          if (repair.outcome != Outcome::done) return;
          if (!arguments.quiet) say("repair: {}\n", summary_of(repair.report));
          planes = std::move(repair.planes);
        }
        add_holes_and_regions(arguments, planes);
        result = solve(planes, options);
        if (result.outcome != Outcome::done) return;
        if (!arguments.quiet) tell_idle_points(arguments, planes, result.report);
        name_parts(arguments, result.mesh);
        write_plane(arguments.output, result.mesh, writing);
        if (!arguments.quiet) tell(not_held(arguments.output, result.mesh, writing), arguments.output);
      },
      [&](Outcome outcome, const std::string& message) {
        result.outcome = outcome;
        result.message = message;
        write_json(arguments.report, report_of(arguments, result, repaired));
      });
  write_json(arguments.report, report_of(arguments, result, repaired));
  return conclude(arguments, result);
}

void add_method(CLI::App& command, PlaneArguments& arguments) {
  command
      .add_option("--method", arguments.method,
                  "How segments are recovered: ears, swaps (default) or partition")
      ->option_text("METHOD");
  command
      .add_option("--ears", arguments.ears,
                  "Which corner ears takes: first (default), best (of triangles), or join (those inside)")
      ->option_text("CHOICE");
  command.add_flag("--partition-first", arguments.partition_first,
                   "Partition: remove points only when all segments exist (paper 2.3), not one by one");
  command.add_flag("--delaunay", arguments.delaunay, "Then swap edges until it is constrained Delaunay");
  command.add_option("--size", arguments.size, "Add points until no edge is longer (with --angle 20)")
      ->option_text("H");
  command
      .add_option(
          "--angle", arguments.angle,
          "Add points until no angle is smaller, in degrees (up to 34; proven to terminate up to 26.45)")
      ->option_text("A");
  command.add_flag("--keep-boundary", arguments.keep_boundary, "Add points only inside, none on segments");
  command.add_option("--max-points", arguments.max_points, "Most points to add (default 10000000)")
      ->check(not_a_count)
      ->option_text("N");
  command.add_flag("--hull", arguments.hull,
                   "Keep everything within the convex hull, not only what segments enclose");
  command
      .add_option("--stop-after", arguments.stop_after,
                  "Write the state after delaunay (swaps, partition), partition, or swap=K: after K swaps")
      ->option_text("STAGE");
  command
      .add_option("--order", arguments.order,
                  "Which missing segment is laid next: given, as in the file, random, or halving: the middle "
                  "one, then those in the middle of both halves (default: one near the previous one)")
      ->option_text("ORDER");
  add_seed(command, arguments.seed);
}

}  // namespace

void add_plane(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<PlaneArguments>();
  CLI::App* command = app.add_subcommand(
      "plane", "Triangulate the plane and keep every segment; without added points, or refined");
  command
      ->add_option(
          "FILE", arguments->input,
          "Points and segments: .poly or .node (Triangle), lines of a .dxf, or polygons in space (.off .obj "
          ".ply .poly ...)")
      ->transform(or_standard_input)
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "Triangles (.off .vtu .msh .mesh .stl ..., any format; .node brings .ele and .edge), -: "
                   "standard output")
      ->transform(or_standard_output)
      ->required()
      ->option_text("FILE");
  add_method(*command, *arguments);
  add_report(*command, arguments->report, "Write counts and times as JSON");
  command->add_option("--hole", arguments->holes, "Leave the region of this point empty (repeatable)")
      ->allow_extra_args(false)
      ->option_text("x,y[,z]");
  command->add_option("--region", arguments->regions, "Number the region of this point (repeatable)")
      ->allow_extra_args(false)
      ->option_text("x,y[,z],ID");
  add_name_option(*command, arguments->names);
  command->add_option("--format", arguments->format, "Format of the triangles, instead of by ending")
      ->option_text("FORMAT");
  add_input_format(*command, arguments->input_format, "Format of the input");
  add_tolerance(*command, arguments->tolerance);
  command
      ->add_option("--arcs", arguments->arcs,
                   ".dxf: divide arcs into straight pieces of at most DEG degrees (else they are refused)")
      ->option_text("DEG");
  command
      ->add_flag(
          "--repair", arguments->repair,
          "First cut segments where they cross, overlap or pass through points; T joins points within it "
          "of each other, and of segments")
      ->option_text("[=T]");
  add_limits(*command, arguments->limits);
  add_quiet(*command, arguments->quiet);
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace holdfast::cli
