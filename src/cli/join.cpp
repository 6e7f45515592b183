// `holdfast join`: the volumes of a divided surface as one file.
#include <memory>

#include "command.h"
#include "common_options.h"
#include "files.h"
#include "files_of_run.h"
#include "holdfast/partition.h"
#include "limits.h"
#include "manifest.h"
#include "partition_option.h"
#include "signals.h"
#include "write_options.h"

namespace holdfast::cli {
namespace {

namespace fs = std::filesystem;

struct JoinArguments {
  fs::path folder, output;
  std::string format;
  WriteArguments writing;
  PartitionArguments pieces;
  LimitArguments limits;
  bool as_parts = false, quiet = false;
};

bool is_vtu(const JoinArguments& arguments) {
  const std::string format =
      arguments.format.empty() ? arguments.output.extension().string() : arguments.format;
  return format == ".vtu" || format == "vtu";
}

/// Positions of mid-edge nodes are dropped, because nodes on an interface concern two parts.
void tell_mid_nodes(const JoinArguments& arguments, bool had_some) {
  if (had_some && !arguments.quiet)
    say("holdfast: {}: mid-edge nodes of the parts are left out; `holdfast convert --order 2` gives a volume "
        "straight ones\n",
        arguments.output.string());
}

/// Reports which data of the surface pieces do not hold; no volume is in memory for it.
void tell_not_held(const JoinArguments& arguments, const Surface& whole, const VolumeTarget& target) {
  if (arguments.quiet) return;
  Volume surface;
  surface.vertices = whole.vertices;
  surface.facets = whole.facets;
  surface.facet_markers = whole.facet_markers;
  surface.segments = whole.segments;
  surface.segment_markers = whole.segment_markers;
  surface.vertex_markers = whole.vertex_markers;
  surface.names = whole.names;
  tell_not_held_by_pieces(target, surface);
}

/// A format that only has pieces keeps the parts, too.
bool keeps_parts(const JoinArguments& arguments) {
  if (arguments.pieces.parts) {
    if (arguments.as_parts) throw UsageError("--as-parts and --partition make other pieces of one mesh");
    return false;
  }
  return arguments.as_parts || volume_format_of(arguments.output, arguments.format) == ".pvtu";
}

int run(const JoinArguments& arguments) {
  const Limits limits = limits_of(arguments.limits);
  const bool as_parts = keeps_parts(arguments);
  FilesOfRun files;
  const Manifest manifest = read_manifest(arguments.folder);
  for (const ManifestPart& part : manifest.parts) files.read_volume(manifest.path_of(part.volume), {});
  VolumeTarget target;
  if (as_parts) {
    target = target_of_pieces(files, "-o", arguments.output, arguments.format, manifest.parts.size(),
                              arguments.writing);
  } else if (arguments.pieces.parts) {
    target = target_of_partition(files, "-o", arguments.output, arguments.format, *arguments.pieces.parts,
                                 arguments.writing);
  } else {
    target = files.write_volume("-o", arguments.output, arguments.format);
    apply(arguments.writing, target);
  }
  watch_writing(target.options, limits);
  cancel_by_flag();
  try {
    const Surface whole = whole_of(manifest, limits);
    bool had_mid_nodes = false;
    const auto load = [&](std::size_t k) {
      Volume volume = volume_of(manifest, k, limits);
      had_mid_nodes = had_mid_nodes || !volume.mid_nodes.empty();
      volume.mid_nodes = {};
      return volume;
    };
    if (as_parts) {
      write_pieces(target.path, manifest.parts.size(),
                   joined_pieces(whole.view(), manifest.parts.size(), load, manifest.interface_marker),
                   target.options);
      tell_not_held(arguments, whole, target);
      tell_mid_nodes(arguments, had_mid_nodes);
      return exit_done;
    }
    if (is_vtu(arguments) && !arguments.pieces.parts) {
      write_joined(target.path, whole.view(), manifest.parts.size(), load, manifest.interface_marker,
                   target.options);
      tell_mid_nodes(arguments, had_mid_nodes);
      return exit_done;
    }
    std::vector<Volume> parts;
    for (std::size_t k = 0; k < manifest.parts.size(); ++k) parts.push_back(load(k));
    tell_mid_nodes(arguments, had_mid_nodes);
    const Volume joined = join_parts(whole.view(), parts, manifest.interface_marker);
    if (arguments.pieces.parts) {
      write_partition(target, *arguments.pieces.parts, joined, arguments.quiet);
      return exit_done;
    }
    write_volume(target.path, joined, target.options);
    if (!arguments.quiet) tell(not_held(target.path, joined, target.options), target.path);
  } catch (const Stale& stale) {
    say("holdfast: {}; nothing was written\n", stale.what());
    return exit_check_failed;
  }
  return exit_done;
}

}  // namespace

void add_join(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<JoinArguments>();
  CLI::App* command = app.add_subcommand("join", "Join the volumes of a split surface");
  command->add_option("DIR", arguments->folder, "The folder of `holdfast split`, with a volume for each part")
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "Volume file (.vtu, with one part in memory at a time; or another that `mesh` writes)")
      ->transform(or_standard_output)
      ->required()
      ->option_text("VOLUME");
  command->add_option("--format", arguments->format, "Volume format, instead of by ending")
      ->option_text("FORMAT");
  command->add_flag(
      "--as-parts", arguments->as_parts,
      "Leave the parts as the pieces of K processes, in the formats of --partition (.pvtu always does)");
  add_partition(*command, arguments->pieces);
  add_write_options(*command, arguments->writing);
  add_limits(*command, arguments->limits);
  add_quiet(*command, arguments->quiet);
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace holdfast::cli
