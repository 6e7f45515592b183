// `holdfast paste`: makes one conformal surface of parts that touch.
#include "holdfast/paste.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <system_error>
#include <utility>

#include "any_mesh.h"
#include "command.h"
#include "common_options.h"
#include "files.h"
#include "files_of_run.h"
#include "holdfast/seeds.h"
#include "holdfast/surface_io.h"
#include "limits.h"
#include "name_options.h"
#include "paste_options.h"
#include "paste_result.h"
#include "repair_result.h"
#include "report.h"
#include "signals.h"
#include "summary.h"
#include "surface_output.h"

namespace holdfast::cli {
namespace {

struct PasteArguments : SurfaceOutput {
  std::vector<std::filesystem::path> surfaces;
  std::string input_format;
  std::optional<std::string> tolerance, overlap;
  std::vector<std::string> names;
  LimitArguments limits;
  unsigned threads = 1;
  bool quiet = false;
};

PasteOptions to_options(const PasteArguments& arguments) {
  PasteOptions options;
  static_cast<Limits&>(options) = limits_of(arguments.limits);
  if (arguments.tolerance) options.tolerance = tolerance_of(*arguments.tolerance, "--tolerance");
  options.overlap = overlap_named(arguments.overlap);
  options.labels = labels_of(arguments.surfaces);
  options.threads = arguments.threads;
  options.progress = goes_on;
  return options;
}

Json options_of(const PasteArguments& arguments) {
  return {{"surfaces", labels_of(arguments.surfaces)},
          {"output", arguments.output.string()},
          {"tolerance", arguments.tolerance ? Json(*arguments.tolerance) : Json(nullptr)},
          {"overlap", arguments.overlap ? Json(*arguments.overlap) : Json(nullptr)},
          {"threads", arguments.threads},
          {"time_limit", arguments.limits.time_limit.value_or(0)},
          {"memory_limit", arguments.limits.memory_limit.value_or(0)}};
}

/// Without seeds, a surface has no place for the regions of its parts: a mesh of the file numbers them by the
/// order of the triangles, so that names of several would come to other regions.
std::size_t leave_out_region_names(PasteResult& result) {
  std::set<int> ids;
  for (const PastedPart& part : result.parts) {
    ids.insert(part.id);
    for (const RegionSeed& seed : part.seeds) ids.insert(seed.id);
  }
  if (ids.size() < 2) return 0;
  return std::exchange(result.surface.names.regions, {}).size();
}

/// Adds seeds of the parts' regions if the format holds them. Returns whether there are any.
bool add_seeds(const PasteArguments& arguments, const PasteOptions& options, const WriteOptions& writing,
               PasteResult& result) {
  if (!holds_seeds(arguments, writing)) return false;
  Options meshing;
  static_cast<Limits&>(meshing) = options;
  meshing.threads = arguments.threads;
  meshing.progress = [](const Progress& at) { return goes_on(at.fraction); };
  result.surface = with_seeds(result, meshing);
  return !result.surface.regions.empty();
}

/// Reports how the run ended and what the user can do; returns the exit code.
int conclude(const PasteArguments& arguments, const PasteResult& result,
             const char* advice = overlap_advice) {
  switch (result.outcome) {
    case Outcome::done:
      if (!arguments.quiet) tell(result, arguments.output);
      return exit_done;
    case Outcome::invalid_input:
      say("holdfast: {}; nothing was written\n", result.message);
      if (!result.overlaps.empty())
        say("{}{}\n", advice,
            arguments.tolerance ? "" : "; --tolerance T joins parts that are nearer than T");
      return exit_invalid_surface;
    case Outcome::time_limit:
    case Outcome::memory_limit:
    case Outcome::cancelled:
      return tell_limit(result.outcome, result.message);
    case Outcome::not_representable:
      say("holdfast: {}; {} was not written; another --tolerance may help\n", result.message,
          arguments.output.string());
      return exit_not_representable;
  }
  return exit_internal_error;
}

/// The contents of the files: volumes if every file has tetrahedra, otherwise surfaces.
struct Parts {
  std::vector<Volume> volumes;
  std::vector<Surface> surfaces;
  std::vector<std::vector<Remark>> remarks;  ///< of volumes
};

/// A pipe can be read only once, and is read as a surface.
bool may_be_volumes(const PasteArguments& arguments) {
  return std::all_of(arguments.surfaces.begin(), arguments.surfaces.end(), [&](const auto& path) {
    std::error_code error;
    return may_be_volume(path, arguments.input_format) && !descriptor_of(path) &&
           (std::filesystem::is_regular_file(path, error) || std::filesystem::is_directory(path, error));
  });
}

Parts read(const PasteArguments& arguments, const PasteOptions& options) {
  Parts parts;
  if (may_be_volumes(arguments))
    for (const auto& path : arguments.surfaces) {
      parts.volumes.push_back(
          read_volume(path, reading(options, arguments.input_format), &parts.remarks.emplace_back()));
      if (parts.volumes.back().tetrahedra.empty()) {
        parts = {};
        break;
      }
    }
  if (parts.volumes.empty())
    parts.surfaces =
        read_parts(arguments.surfaces, reading(options, arguments.input_format, options.tolerance));
  return parts;
}

/// Regions with one id and no name become one region, even from several files.
void tell_joined_regions(const std::vector<std::filesystem::path>& files,
                         const std::vector<Volume>& volumes) {
  std::map<int, std::size_t> first;  // the first file that has the id
  std::set<int> told;
  for (std::size_t k = 0; k < volumes.size(); ++k)
    for (const int id : std::set<int>(volumes[k].regions.begin(), volumes[k].regions.end())) {
      if (id == 0 || volumes[k].names.regions.contains(id)) continue;
      const auto [before, is_first] = first.try_emplace(id, k);
      if (!is_first && told.insert(id).second)
        say("holdfast: region {} of {} and of {} is one; to keep them apart, give them names: "
            "`holdfast convert {} OUT --name region:{}=NAME`\n",
            id, files[before->second].string(), files[k].string(), files[k].string(), id);
    }
}

int paste_volumes(const PasteArguments& arguments, const PasteOptions& options, FilesOfRun& files,
                  const std::vector<Volume>& volumes) {
  if (volumes.size() < 2) throw UsageError("paste: two volumes at least are expected");
  VolumeTarget target = files.write_volume("-o", arguments.output, arguments.format);
  target.options.threads = arguments.threads;
  watch_writing(target.options, options);
  PastedVolumes result = paste(volumes, options, stems(arguments.surfaces));
  merge(result.volume.names, names_of(arguments.names));
  if (result.outcome == Outcome::done) {
    write_volume(target.path, result.volume, target.options);
    if (!arguments.quiet) {
      tell_joined_regions(arguments.surfaces, volumes);
      tell(not_held(target.path, result.volume, target.options), target.path);
      tell_idle_names(arguments.names, nameable_in(result.volume));
    }
    write_parents(arguments.parents, 0, result.boundary);  // volumes bring no segments
  }
  write_json(arguments.report, to_json(result, options_of(arguments)));
  result.boundary.outcome = result.outcome;
  result.boundary.message = result.message;
  const int code =
      conclude(arguments, result.boundary,
               "tetrahedra of volumes stay, so that --overlap is for surfaces: `holdfast convert "
               "VOLUME SURFACE` makes one of a volume");
  if (code == exit_done && !arguments.quiet)
    say("{}: {}, in place of {} of the files'\n", arguments.output.string(),
        counted(static_cast<std::size_t>(std::count(result.origin.begin(), result.origin.end(), -1)),
                "new tetrahedron", "new tetrahedra"),
        result.replaced);
  return code;
}

int paste_surfaces(const PasteArguments& arguments, const PasteOptions& options, FilesOfRun& files,
                   std::optional<WriteOptions> target, const std::vector<Surface>& parts) {
  WriteOptions writing = target ? *target : files.write_surface("-o", arguments.output, arguments.format);
  watch_writing(writing, options);
  PasteResult result = parts.size() == 1 ? paste_components(parts[0], options)
                                         : paste(parts, options, stems(arguments.surfaces));
  merge(result.surface.names, names_of(arguments.names));
  if (result.outcome == Outcome::done) {
    const bool has_seeds = add_seeds(arguments, options, writing, result);
    const std::size_t left_out = has_seeds ? 0 : leave_out_region_names(result);
    write_and_tell(arguments, result.surface, writing, arguments.quiet);
    if (!arguments.quiet) {
      if (left_out > 0)
        say("holdfast: {} left out, since a mesh of {} numbers its regions anew; `mesh --paste` of the parts "
            "keeps them\n",
            counted(left_out, "name of a region is", "names of regions are"), arguments.output.string());
      tell_idle_names(arguments.names, nameable_in(result.surface));
    }
    std::size_t facets = 0;
    for (const Surface& part : parts) facets += part.facets.size();
    write_parents(arguments.parents, facets, result);
  }
  write_json(arguments.report, to_json(result, options_of(arguments)));
  return conclude(arguments, result);
}

int paste_files(const PasteArguments& arguments, const PasteOptions& options, FilesOfRun& files,
                const std::optional<WriteOptions>& target) {
  const Parts parts = read(arguments, options);
  if (!arguments.quiet) {
    for (std::size_t k = 0; k < parts.volumes.size(); ++k) tell(parts.remarks[k], arguments.surfaces[k]);
    for (const Surface& part : parts.surfaces) tell(part.remarks);
  }
  return parts.volumes.empty() ? paste_surfaces(arguments, options, files, target, parts.surfaces)
                               : paste_volumes(arguments, options, files, parts.volumes);
}

int run(const PasteArguments& arguments) {
  const PasteOptions options = to_options(arguments);
  static_cast<void>(names_of(arguments.names));  // reports wrong usage before anything is read
  FilesOfRun files;
  std::optional<WriteOptions> target;  // if it is a surface for certain before anything is read
  if (may_be_volumes(arguments)) {
    for (const auto& path : arguments.surfaces) files.read_volume(path, arguments.input_format);
  } else {
    files.read_surfaces(arguments.surfaces, arguments.input_format);
    target = files.write_surface("-o", arguments.output, arguments.format);
  }
  files.write("--parents", arguments.parents);
  files.write("--report", arguments.report);
  cancel_by_flag();
  return work_or_report(
      options, [&] { return paste_files(arguments, options, files, target); },
      [&](Outcome outcome, const std::string& message) {
        PasteResult ended;
        ended.outcome = outcome;
        ended.message = message;
        write_json(arguments.report, to_json(ended, options_of(arguments)));
      });
}

}  // namespace

void add_paste(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<PasteArguments>();
  CLI::App* command = app.add_subcommand(
      "paste",
      "Make one conformal surface of parts that touch: common faces occur once, with the same triangles");
  command
      ->add_option("SURFACE", arguments->surfaces,
                   "Surface files, one per part, as for `mesh`, or one whose components are the parts; they "
                   "are numbered one after the other")
      ->transform(or_standard_input)
      ->required();
  add_surface_output(*command, *arguments);
  command
      ->add_option("--tolerance", arguments->tolerance,
                   "Put vertices that are nearer than this to an earlier file on it (the first file stays); "
                   "also the limit for the distance of a polygon's corners from its plane")
      ->option_text("T");
  add_overlap_option(*command, arguments->overlap);
  add_account(*command, *arguments);
  add_name_option(*command, arguments->names);
  add_surface_format(*command, *arguments);
  add_input_format(*command, arguments->input_format, "Format of the input");
  add_threads(*command, arguments->threads);
  add_limits(*command, arguments->limits);
  add_quiet(*command, arguments->quiet);
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace holdfast::cli
