// The output of a volume: a volume file, a surface file, or a file for each region.
#pragma once

#include <filesystem>
#include <string>

#include "any_mesh.h"
#include "files_of_run.h"
#include "order_options.h"
#include "partition_option.h"
#include "write_options.h"

namespace holdfast::cli {

/// The help of --each-region.
inline constexpr const char* each_region_help =
    "Write a file for each region, NAME_REGION with its name or region_ID; a surface format gets the "
    "region's closed surface, facing outwards";

/// The help of --no-interfaces.
inline constexpr const char* no_interfaces_help =
    "Leave out triangles with tetrahedra on both sides, as deal.II requires";

/// The user's arguments.
struct OutputArguments {
  std::filesystem::path path;
  std::string format;
  WriteArguments writing;
  PartitionArguments pieces;
  bool each_region = false, no_interfaces = false;
};

/// Names the file and determines its options. Throws UsageError.
[[nodiscard]] AnyTarget output_target(FilesOfRun& files, const char* option,
                                      const OutputArguments& arguments);

/// Throws UsageError before any work. Elements of second order of a file are found when it is read.
void refuse_second_order_in_pieces(const OrderArguments& order, const PartitionArguments& pieces);

/// Writes a volume or, if the format only holds surfaces, its boundary and interfaces, and says so unless
/// `quiet`. Throws FileError, and UsageError if a region's file would replace one that is in use.
void write_output(FilesOfRun& files, const OutputArguments& arguments, const AnyTarget& target,
                  const Volume& volume, bool quiet);

/// Reports that a file cannot hold the tetrahedra and region ids of a volume.
void tell_of_surface_alone(const std::filesystem::path& path, const Volume& volume);

}  // namespace holdfast::cli
