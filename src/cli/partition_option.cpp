#include "partition_option.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <limits>

#include "command.h"
#include "files.h"
#include "holdfast/partition.h"
#include "limits.h"
#include "summary.h"

namespace holdfast::cli {
namespace {

/// Up to this number of pieces, files named later are compared with each of them.
constexpr std::size_t kNamedEach = 1000;

}  // namespace

void add_partition(CLI::App& command, PartitionArguments& arguments) {
  command
      .add_option(
          "--partition", arguments.parts,
          "Write K pieces of equal size for K processes, each with its interfaces and a layer of ghosts "
          "(.pvtu .msh .xdmf, or OpenFOAM's processorN; by METIS)")
      ->check(not_a_count)
      ->option_text("K");
}

VolumeTarget target_of_pieces(FilesOfRun& files, std::string_view option, const std::filesystem::path& path,
                              std::string format, std::size_t pieces, const WriteArguments& writing) {
  VolumeTarget target{path, {}};
  target.options.format = std::move(format);
  const std::string kind = format_of(target);
  target.options.format = kind;
  if (!is_one_of(piece_formats(), kind))
    throw UsageError(fmt::format(
        "{}: {} not written in pieces; use {} as the file's ending or by --format", path.string(),
        kind.empty() ? "a file without an ending is" : "'" + kind + "' is", fmt::join(piece_formats(), " ")));
  if (descriptor_of(path)) throw UsageError(fmt::format("{}: pieces need a name", path.string()));
  if (writing.one_file) throw UsageError("--one-file does nothing for pieces, which have files of their own");
  apply(writing, target);
  // Pieces have different names. If they are many, each is compared only with the other files. Folders of
  // OpenFOAM's processes are created with their files.
  const FilesOfRun others = files;
  for (const std::filesystem::path& file : files_of_pieces(path, pieces, kind)) {
    if (pieces <= kNamedEach) {
      files.write(option, file, kind == ".openfoam");
    } else {
      FilesOfRun both = others;
      both.write(option, file, kind == ".openfoam");
    }
  }
  return target;
}

VolumeTarget target_of_partition(FilesOfRun& files, std::string_view option,
                                 const std::filesystem::path& path, const std::string& format,
                                 std::size_t pieces, const WriteArguments& writing) {
  if (pieces == 0) throw UsageError("--partition: one part or more are expected");
  if (pieces > std::size_t{std::numeric_limits<std::int32_t>::max()})
    throw UsageError("--partition: more parts than can be numbered");
  if (!has_metis())
    throw UsageError("--partition: this program was built without METIS (Debian: libmetis-dev)");
  return target_of_pieces(files, option, path, format, pieces, writing);
}

void write_partition(const VolumeTarget& target, std::size_t pieces, const Volume& volume, bool quiet) {
  if (pieces > volume.tetrahedra.size())
    throw UsageError(fmt::format("--partition {}: the mesh has {}; nothing was written", pieces,
                                 counted(volume.tetrahedra.size(), "tetrahedron", "tetrahedra")));
  if (!volume.mid_nodes.empty())
    throw UsageError("--partition: elements of second order are not written in pieces; nothing was written");
  write_pieces(target.path, pieces, pieces_of(volume, partition(volume, pieces), pieces), target.options);
  if (!quiet) tell_not_held_by_pieces(target, volume);
}

void tell_not_held_by_pieces(const VolumeTarget& target, const Volume& volume) {
  // The loss does not depend on pieces. A format that only has pieces loses nothing.
  if (is_one_of(volume_formats(), format_of(target)))
    tell(not_held(target.path, volume, target.options), target.path);
}

}  // namespace holdfast::cli
