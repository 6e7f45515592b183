#include "mesh_output.h"

#include <fmt/core.h>

#include <cctype>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "command.h"
#include "files.h"
#include "holdfast/surface_io.h"
#include "letters.h"
#include "parts_of_mesh.h"
#include "summary.h"

namespace holdfast::cli {
namespace {

namespace fs = std::filesystem;

void write_one(const fs::path& path, const AnyTarget& target, const Volume& volume, bool quiet) {
  if (target.holds_volumes) {
    write_volume(path, volume, target.options);
    if (!quiet) tell(not_held(path, volume, target.options), path);
    return;
  }
  const Surface surface = surface_of(volume);
  write_surface(path, surface, target.options);
  if (!quiet) tell(not_held(path, surface, target.options), path);
}

/// A name as part of a file name: keeps UTF-8 and, of ASCII, letters, digits and characters safe everywhere.
std::string in_file_name(const std::string& name) {
  constexpr std::size_t longest = 100;
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool stays = byte >= 0x80 || std::isalnum(byte) != 0 || c == '-' || c == '.' || c == '_';
    text += stays ? c : '_';
  }
  if (text.size() <= longest) return text;
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // not within a character
  return text.substr(0, end);
}

/// The file of each region, by id.
std::map<int, fs::path> files_of_regions(const fs::path& path, const Volume& volume) {
  std::map<int, fs::path> files;
  std::set<std::string> taken;
  for (const int id : std::set<int>(volume.regions.begin(), volume.regions.end())) {
    const auto found = volume.names.regions.find(id);
    const bool named = found != volume.names.regions.end() && !found->second.empty();
    std::string name = named ? in_file_name(found->second) : fmt::format("region_{}", id);
    // Some file systems ignore case.
    while (!taken.insert(lower(name)).second) name += fmt::format("_{}", id);
    fs::path file = path.stem();
    file += "_" + name;
    file += path.extension();
    files[id] = path.parent_path() / file;
  }
  return files;
}

using FileOfRegion = std::pair<int, fs::path>;

/// Takes the volume apart by halves of the regions, since to search all of it for each region would take as
/// many times as long as there are regions.
void write_regions(const Volume& volume, std::span<const FileOfRegion> files, const AnyTarget& target,
                   bool quiet) {
  const auto part_of_regions = [&](std::span<const FileOfRegion> of) {
    Part regions{Part::Kind::regions, {}};
    for (const auto& [id, path] : of) regions.regions.push_back(std::to_string(id));
    AnyMesh part{true, volume, {}, {}};
    take_part(part, regions);
    return std::move(part.volume);
  };
  if (files.size() == 1) {
    const auto& [id, path] = files[0];
    write_one(path, target, part_of_regions(files), quiet);
    if (!quiet) say("{}: region {}\n", path.string(), id);
    return;
  }
  const std::size_t middle = files.size() / 2;
  for (const std::span half : {files.first(middle), files.subspan(middle)})
    if (!half.empty()) write_regions(part_of_regions(half), half, target, quiet);
}

}  // namespace

void tell_of_surface_alone(const fs::path& path, const Volume& volume) {
  const std::set<int> regions(volume.regions.begin(), volume.regions.end());
  say("holdfast: {}: the format holds only surfaces: {} and the ids of {} are left out\n", path.string(),
      counted(volume.tetrahedra.size(), "tetrahedron", "tetrahedra"), counted(regions.size(), "region"));
}

AnyTarget output_target(FilesOfRun& files, const char* option, const OutputArguments& arguments) {
  if (arguments.pieces.parts && arguments.each_region)
    throw UsageError("--partition and --each-region are two ways to cut a mesh; give one of them");
  AnyTarget target;
  if (arguments.pieces.parts) {
    target.options = target_of_partition(files, option, arguments.path, arguments.format,
                                         *arguments.pieces.parts, arguments.writing)
                         .options;
    target.holds_volumes = true;
    return target;
  }
  target = write_any(files, option, arguments.path, arguments.format);
  VolumeTarget written{arguments.path, target.options};
  apply(arguments.writing, written);
  target.options = written.options;
  if (arguments.no_interfaces && !target.holds_volumes)
    throw UsageError(
        fmt::format("--no-interfaces does nothing for {}: it is for volumes", arguments.path.string()));
  if (arguments.each_region && (arguments.path == "/dev/stdout" || format_of(written) == ".openfoam"))
    throw UsageError("--each-region needs the name of a file, beside which those of the regions are written");
  return target;
}

void refuse_second_order_in_pieces(const OrderArguments& order, const PartitionArguments& pieces) {
  if (pieces.parts && order.order == 2)
    throw UsageError("--partition: elements of second order (--order 2) are not written in pieces");
}

void write_output(FilesOfRun& files, const OutputArguments& arguments, const AnyTarget& target,
                  const Volume& all, bool quiet) {
  Volume without;
  if (arguments.no_interfaces) drop_interfaces(without = all);
  const Volume& volume = arguments.no_interfaces ? without : all;
  if (arguments.pieces.parts)
    return write_partition({arguments.path, target.options}, *arguments.pieces.parts, volume, quiet);
  if (!arguments.each_region) {
    if (!target.holds_volumes && !quiet) tell_of_surface_alone(arguments.path, volume);
    return write_one(arguments.path, target, volume, quiet);
  }
  const std::map<int, fs::path> paths = files_of_regions(arguments.path, volume);
  for (const auto& [id, path] : paths)
    static_cast<void>(write_any(files, "--each-region", path, arguments.format));
  write_regions(volume, std::vector<FileOfRegion>(paths.begin(), paths.end()), target, quiet);
}

}  // namespace holdfast::cli
