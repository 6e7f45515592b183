// --partition, for commands that write a volume.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "files_of_run.h"
#include "write_options.h"

namespace holdfast::cli {

struct PartitionArguments {
  std::optional<std::size_t> parts;
};

void add_partition(CLI::App& command, PartitionArguments& arguments);

/// Where and how to write a volume in pieces. Throws UsageError for formats without pieces, and for options
/// that do nothing there.
[[nodiscard]] VolumeTarget target_of_pieces(FilesOfRun& files, std::string_view option,
                                            const std::filesystem::path& path, std::string format,
                                            std::size_t pieces, const WriteArguments& writing);
/// The same for pieces that METIS makes.
[[nodiscard]] VolumeTarget target_of_partition(FilesOfRun& files, std::string_view option,
                                               const std::filesystem::path& path, const std::string& format,
                                               std::size_t pieces, const WriteArguments& writing);

/// Partitions the volume by METIS, writes the pieces and, unless `quiet`, reports what the files do not hold.
/// Throws UsageError for more pieces than tetrahedra, and for elements of second order.
void write_partition(const VolumeTarget& target, std::size_t pieces, const Volume& volume, bool quiet);

/// Reports what the format of the pieces does not hold of a volume.
void tell_not_held_by_pieces(const VolumeTarget& target, const Volume& volume);

}  // namespace holdfast::cli
