// `holdfast split`: splits a surface into parts that are meshed separately.
#include <fmt/core.h>

#include <memory>
#include <set>

#include "command.h"
#include "common_options.h"
#include "files.h"
#include "files_of_run.h"
#include "holdfast/surface_io.h"
#include "limits.h"
#include "manifest.h"
#include "mesh_options.h"
#include "name_options.h"
#include "signals.h"
#include "staged_folder.h"
#include "summary.h"

namespace holdfast::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* whole_name = "surface.vtu";  ///< the copy of the whole surface

struct SplitArguments {
  MeshArguments mesh;  ///< only surfaces, sizes, regions and holes
  std::size_t parts = 0;
  fs::path folder;
  LimitArguments limits;
};

DivideOptions to_options(const SplitArguments& arguments, const Surface& surface) {
  const Options mesh = cli::to_options(arguments.mesh);
  if (mesh.keep == Keep::box) throw UsageError("--keep box: a surface in a box cannot be split");
  DivideOptions options;
  options.parts = arguments.parts;
  options.size = mesh.sizes->size;
  options.keep = mesh.keep;
  options.holes = mesh.holes;
  options.holes.insert(options.holes.end(), surface.holes.begin(), surface.holes.end());
  options.regions = mesh.regions;
  options.regions.insert(options.regions.end(), surface.regions.begin(), surface.regions.end());
  options.drop_outside = mesh.drop_outside;
  options.seed = mesh.seed;
  options.threads = mesh.threads;
  options.progress = goes_on;
  return options;
}

std::string numbered(std::size_t k, std::size_t count, const char* ending) {
  return fmt::format("part_{:0{}}{}", k + 1, std::to_string(count).size(), ending);
}

Json json_of_part(const SurfacePart& part, const fs::path& file, std::size_t k, std::size_t count) {
  Json sizes = Json::array();
  std::set<int> regions;
  for (const RegionSeed& seed : part.surface.regions) {
    regions.insert(seed.id);
    if (seed.size > 0) sizes.push_back({{"region", seed.id}, {"size", seed.size}});
  }
  return {{"surface", file.filename().string()},
          {"volume", numbered(k, count, ".vtu")},
          {"crc32", checksum_of(file)},
          {"triangles", part.surface.facets.size()},
          {"interface_triangles", part.interface_facets},
          {"tetrahedra_expected", std::llround(part.tetrahedra)},
          {"regions", regions},
          {"sizes", sizes}};
}

/// Writes all files or none. The manifest is last: without it, the folder is no division.
void write_division(const SplitArguments& arguments, const Surface& surface, const SurfaceDivision& division,
                    const Limits& limits) {
  StagedFolder staged(arguments.folder);
  WriteOptions writing;
  watch_writing(writing, limits);
  const auto write = [&](const std::string& name, const Surface& written) {
    staged.write(name, [&](const fs::path& path) { write_surface(path, written, writing); });
  };
  write(whole_name, surface);
  Json parts = Json::array();
  const std::size_t count = division.parts.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::string name = numbered(k, count, ".poly");
    write(name, division.parts[k].surface);
    parts.push_back(json_of_part(division.parts[k], staged.of(name), k, count));
  }
  Json inputs = Json::array();
  for (const auto& path : arguments.mesh.surfaces) inputs.push_back(path.string());
  const Json manifest = {{"format", "holdfast division"},
                         {"version", 1},
                         {"holdfast", version()},
                         {"inputs", inputs},
                         {"options",
                          {{"parts", arguments.parts},
                           {"size", arguments.mesh.size ? Json(*arguments.mesh.size) : Json(nullptr)},
                           {"keep", arguments.mesh.keep.value_or("auto")},
                           {"drop_outside", arguments.mesh.drop_outside},
                           {"seed", arguments.mesh.seed}}},
                         {"surface",
                          {{"file", whole_name},
                           {"crc32", checksum_of(staged.of(whole_name))},
                           {"vertices", surface.vertices.size()},
                           {"triangles", surface.facets.size()},
                           {"segments", surface.segments.size()}}},
                         {"interface_marker", division.interface_marker},
                         {"names", to_json(surface.names)},
                         {"parts", parts}};
  staged.write(manifest_name, [&](const fs::path& path) { write_json(path, manifest); });
  staged.publish(manifest_name);
}

bool is_part(const fs::path& file) {
  return file.filename().string().starts_with("part_") && file.extension() == ".poly";
}

/// Names the files of the division, none of which may be an input: its manifest, and the others that exist.
void name_files(const fs::path& folder, FilesOfRun& files) {
  files.write("-o", folder / manifest_name, true);
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().filename() == whole_name || is_part(entry.path())) files.write("-o", entry.path());
  }
}

/// Reports parts left from an earlier division with more parts: a pattern such as `part_*.poly` would include
/// them.
void tell_left_parts(const fs::path& folder, std::size_t parts) {
  std::set<fs::path> names, left;
  for (std::size_t k = 0; k < parts; ++k) names.insert(numbered(k, parts, ".poly"));
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    if (is_part(entry.path()) && !names.contains(entry.path().filename())) left.insert(entry.path());
  for (const fs::path& path : left)
    say("holdfast: {} is left from an earlier split, and none of these parts\n", path.string());
}

int conclude(const SplitArguments& arguments, const SurfaceDivision& division) {
  switch (division.outcome) {
    case Outcome::done: {
      if (arguments.mesh.quiet) return exit_done;
      std::size_t triangles = 0;
      double least = HUGE_VAL, most = 0;
      for (const SurfacePart& part : division.parts) {
        triangles += part.interface_facets;
        least = std::min(least, part.tetrahedra);
        most = std::max(most, part.tetrahedra);
      }
      say("{}: {} with {} between them; {:.3g} to {:.3g} tetrahedra each, estimated\n",
          (arguments.folder / manifest_name).string(), counted(division.parts.size(), "part"),
          counted(triangles / 2, "triangle"), least, most);
      if (division.parts.size() < arguments.parts)
        say("holdfast: the mesh is too coarse for {} parts\n", arguments.parts);
      tell_left_parts(arguments.folder, division.parts.size());
      return exit_done;
    }
    case Outcome::invalid_input:
      say("holdfast: the surface is not valid: {}\n", division.message);
      print_defects(division.defects, 20);
      return exit_invalid_surface;
    case Outcome::time_limit:
    case Outcome::memory_limit:
    case Outcome::cancelled:
      say("holdfast: {}; nothing was written\n",
          division.message.empty() ? name(division.outcome) : division.message);
      return exit_limit;
    case Outcome::not_representable:
      say("holdfast: {}; nothing was written\n", division.message);
      return exit_not_representable;
  }
  return exit_internal_error;
}

int run(const SplitArguments& arguments) {
  if (arguments.parts == 0) throw UsageError("--parts: one or more are expected");
  if (arguments.folder == "-")
    throw UsageError("-o: the name of a folder is expected; parts are several files");
  const Limits limits = limits_of(arguments.limits);
  const Names names = names_of(arguments.mesh.names);
  FilesOfRun files;
  files.read_surfaces(arguments.mesh.surfaces, arguments.mesh.input_format);
  name_files(arguments.folder, files);
  cancel_by_flag();
  Surface surface = read_surfaces(arguments.mesh.surfaces,
                                  reading(limits, arguments.mesh.input_format, arguments.mesh.tolerance));
  if (!arguments.mesh.quiet) tell(surface.remarks);
  merge(surface.names, names);
  if (!arguments.mesh.quiet) tell_idle_names(arguments.mesh.names, nameable_in(surface));
  DivideOptions options = to_options(arguments, surface);
  static_cast<Limits&>(options) = limits;

  SurfaceDivision division;
  try {
    division = divide(surface.view(), options);
  } catch (const std::invalid_argument& error_of_options) {
    throw UsageError(error_of_options.what());
  }
  if (division.outcome == Outcome::done) write_division(arguments, surface, division, limits);
  return conclude(arguments, division);
}

}  // namespace

void add_split(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<SplitArguments>();
  MeshArguments& mesh = arguments->mesh;
  CLI::App* command =
      app.add_subcommand("split", "Cut a surface into closed parts that are meshed separately and fit");
  command->add_option("SURFACE", mesh.surfaces, "Surface files, as for `mesh`")
      ->transform(or_standard_input)
      ->required();
  command->add_option("-o,--output", arguments->folder, "Folder for the parts and manifest.json")
      ->required()
      ->option_text("DIR");
  command->add_option("--parts", arguments->parts, "Number of parts, of about equal work")
      ->check(not_a_count)
      ->required()
      ->option_text("N");
  command->add_option("--size", mesh.size, "No edge inside much longer than this, in all parts")
      ->option_text("H");
  command->add_option("--keep", mesh.keep, "Regions to keep: auto (default), bounded or winding")
      ->option_text("RULE");
  command->add_option("--hole", mesh.holes, "Leave the region that contains this point empty (repeatable)")
      ->allow_extra_args(false)
      ->option_text("x,y,z");
  command
      ->add_option("--region", mesh.regions,
                   "Number the region that contains this point, and limit its size (repeatable)")
      ->allow_extra_args(false)
      ->option_text("x,y,z,ID[,H]");
  add_name_option(*command, mesh.names);
  command->add_flag("--drop-outside", mesh.drop_outside,
                    "Drop facets outside every kept region instead of refusing them");
  add_seed(*command, mesh.seed);
  add_threads(*command, mesh.threads);
  add_input_format(*command, mesh.input_format, "Surface format");
  add_tolerance(*command, mesh.tolerance);
  add_limits(*command, arguments->limits);
  add_quiet(*command, mesh.quiet);
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace holdfast::cli
