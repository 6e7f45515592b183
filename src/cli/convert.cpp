// `holdfast convert`: a surface or a volume in another format.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "any_mesh.h"
#include "command.h"
#include "common_options.h"
#include "files.h"
#include "files_of_run.h"
#include "holdfast/surface_io.h"
#include "limits.h"
#include "mesh_output.h"
#include "name_options.h"
#include "order_options.h"
#include "parts_of_mesh.h"
#include "signals.h"
#include "summary.h"

namespace holdfast::cli {
namespace {

struct ConvertArguments {
  std::filesystem::path input;
  OutputArguments output;
  std::string input_format;
  std::vector<std::string> only, names;
  std::optional<double> scale;
  OrderArguments order;
  LimitArguments limits;
  unsigned threads = 1;
  double tolerance = 0;
  bool quiet = false;
};

/// A surface format takes the surface of a volume; a volume format takes a surface as a volume without
/// tetrahedra. Says what is lost.
void suit(AnyMesh& mesh, const ConvertArguments& arguments, const AnyTarget& target) {
  if (mesh.is_volume && !target.holds_volumes) {
    if (part_of(arguments.only).kind == Part::Kind::volume)
      throw UsageError(fmt::format("{}: the format holds only surfaces, and --only volume leaves none",
                                   arguments.output.path.string()));
    if (!arguments.quiet) tell_of_surface_alone(arguments.output.path, mesh.volume);
    mesh.surface = surface_of(mesh.volume);
    mesh.is_volume = false;
  } else if (!mesh.is_volume && !target.holds_surfaces) {
    Surface& surface = mesh.surface;
    const std::size_t seeds = surface.regions.size() + surface.holes.size();
    if (!arguments.quiet && seeds > 0)
      say("holdfast: {}: {} left out\n", arguments.output.path.string(),
          counted(seeds, "seed of a region or hole is", "seeds of regions and holes are"));
    Volume& volume = mesh.volume;
    volume = {};
    volume.vertices = std::move(surface.vertices);
    volume.facets = std::move(surface.facets);
    volume.segments = std::move(surface.segments);
    volume.facet_markers = std::move(surface.facet_markers);
    volume.segment_markers = std::move(surface.segment_markers);
    volume.vertex_markers = std::move(surface.vertex_markers);
    volume.names = std::move(surface.names);
    mesh.is_volume = true;
  }
}

void write(const AnyMesh& mesh, const ConvertArguments& arguments, const AnyTarget& target) {
  const std::filesystem::path& path = arguments.output.path;
  const WriteOptions& options = target.options;
  if (mesh.is_volume) {
    if (arguments.output.pieces.parts)
      return write_partition({path, options}, *arguments.output.pieces.parts, mesh.volume, arguments.quiet);
    write_volume(path, mesh.volume, options);
    if (!arguments.quiet) tell(not_held(path, mesh.volume, options), path);
  } else {
    write_surface(path, mesh.surface, options);
    if (!arguments.quiet) tell(not_held(path, mesh.surface, options), path);
  }
}

/// Gives a volume, which is scaled already, its order. The smooth surface and the tolerance have the unit of
/// the input.
void set_order(Volume& volume, const ConvertArguments& arguments, const Limits& limits) {
  OrderArguments order = arguments.order;
  std::optional<Surface> smooth = read_curved(order, limits);
  if (smooth && arguments.scale) {
    AnyMesh scaled{false, {}, std::move(*smooth), {}};
    static_cast<void>(scale(scaled, *arguments.scale));
    smooth = std::move(scaled.surface);
    if (order.tolerance) *order.tolerance *= *arguments.scale;
  }
  set_order(volume, order, smooth, limits, arguments.quiet);
}

int run(const ConvertArguments& arguments) {
  if (arguments.scale && !(*arguments.scale > 0 && std::isfinite(*arguments.scale)))
    throw UsageError(fmt::format("--scale {}: a positive and finite number is expected", *arguments.scale));
  const Part part = part_of(arguments.only);
  const Names names = names_of(arguments.names);
  const Limits limits = limits_of(arguments.limits);
  FilesOfRun files;
  read_any(files, arguments.input, arguments.input_format);
  take_order(arguments.order, files);
  AnyTarget target = output_target(files, "the output", arguments.output);
  refuse_second_order_in_pieces(arguments.order, arguments.output.pieces);
  target.options.threads = arguments.threads;
  watch_writing(target.options, limits);
  cancel_by_flag();
  AnyMesh mesh = read_any(arguments.input, reading(limits, arguments.input_format, arguments.tolerance));
  if (!arguments.quiet) tell(mesh.remarks, arguments.input);
  merge(mesh.names(), names);
  const bool was_volume = mesh.is_volume;
  take_part(mesh, part);
  if (!arguments.quiet && !arguments.names.empty()) {
    Nameable there = mesh.is_volume ? nameable_in(mesh.volume) : nameable_in(mesh.surface);
    if (was_volume) there.regions_are_known = true;
    tell_idle_names(arguments.names, there);
  }
  if (arguments.scale)
    if (const std::size_t turned = scale(mesh, *arguments.scale); turned > 0)
      say("holdfast: --scale: rounding turns or flattens {}; a power of two rounds nothing\n",
          counted(turned, "tetrahedron", "tetrahedra"));
  if (arguments.output.each_region) {
    if (!mesh.is_volume) throw UsageError("--each-region: the file holds no tetrahedra, but a surface");
    if (arguments.order.order) set_order(mesh.volume, arguments, limits);
    write_output(files, arguments.output, target, mesh.volume, arguments.quiet);
    return exit_done;
  }
  if (arguments.output.no_interfaces) {
    if (!mesh.is_volume) throw UsageError("--no-interfaces: the file holds no tetrahedra, but a surface");
    drop_interfaces(mesh.volume);
  }
  suit(mesh, arguments, target);
  if (const std::size_t nodes = mesh.volume.mid_nodes.points.size();
      nodes > 0 && !mesh.is_volume && !arguments.quiet)
    say("holdfast: {}: surfaces are of first order: {} left out\n", arguments.output.path.string(),
        counted(nodes, "mid-edge node is", "mid-edge nodes are"));
  if (arguments.order.order) {
    if (!mesh.is_volume || mesh.volume.tetrahedra.empty())
      throw UsageError("--order: only volumes have an order, and this is a surface");
    set_order(mesh.volume, arguments, limits);
  }
  write(mesh, arguments, target);
  if (arguments.quiet) return exit_done;
  const bool has_tetrahedra = mesh.is_volume && !mesh.volume.tetrahedra.empty();
  say("{}: {}, {}{}, {}\n", arguments.output.path.string(),
      counted(mesh.is_volume ? mesh.volume.vertices.size() : mesh.surface.vertices.size(), "vertex",
              "vertices"),
      has_tetrahedra ? counted(mesh.volume.tetrahedra.size(), "tetrahedron, ", "tetrahedra, ") : "",
      counted(mesh.is_volume ? mesh.volume.facets.size() : mesh.surface.facets.size(), "triangle"),
      counted(mesh.is_volume ? mesh.volume.segments.size() : mesh.surface.segments.size(), "segment"));
  return exit_done;
}

}  // namespace

void add_convert(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command = app.add_subcommand(
      "convert", "Convert a surface or a volume to another format, and report what is lost");
  command->add_option("IN", arguments->input, "Surface or volume file, as for `mesh` and `check`")
      ->transform(or_standard_input)
      ->required();
  command->add_option("OUT,-o,--output", arguments->output.path, "File to write, -: standard output")
      ->transform(or_standard_output)
      ->required();
  command
      ->add_option("--only", arguments->only,
                   "volume (without triangles and segments), surface, or region=ID (or its name; repeatable)")
      ->allow_extra_args(false)
      ->option_text("PART");
  command->add_flag("--each-region", arguments->output.each_region, each_region_help);
  command->add_flag("--no-interfaces", arguments->output.no_interfaces, no_interfaces_help);
  command->add_option("--scale", arguments->scale, "Multiply all lengths")->option_text("F");
  add_name_option(*command, arguments->names);
  add_order(*command, arguments->order);
  add_write_options(*command, arguments->output.writing);
  add_partition(*command, arguments->output.pieces);
  command
      ->add_option("--format", arguments->output.format,
                   "Format to write, instead of by ending; msh2 is .msh 2.2, fluent Fluent's .msh")
      ->option_text("FORMAT");
  add_input_format(*command, arguments->input_format, "Format to read");
  add_threads(*command, arguments->threads);
  add_tolerance(*command, arguments->tolerance);
  add_limits(*command, arguments->limits);
  add_quiet(*command, arguments->quiet);
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace holdfast::cli
