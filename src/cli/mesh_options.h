// The options of `holdfast mesh` as the command line spells them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bound_options.h"
#include "extent.h"
#include "holdfast/holdfast.h"
#include "holdfast/repair.h"
#include "mesh_output.h"
#include "order_options.h"
#include "repair_options.h"
#include "report.h"

namespace holdfast::cli {

/// The user's arguments.
struct MeshArguments {
  std::vector<std::filesystem::path> surfaces;
  std::filesystem::path report, exact, html, repaired;
  OutputArguments output;
  std::string input_format;
  double tolerance = 0;
  bool surface_of = false, fill = false, drop_outside = false, drop_unused = false, quiet = false,
       verbose = false;
  std::optional<std::string> keep, quality, overlap;
  std::optional<std::string> paste;   ///< the tolerance; empty if none is given
  std::optional<std::string> repair;  ///< the tolerance, or "true"
  RepairWays repair_ways;
  std::vector<std::string> holes, regions, without, names;
  std::string stop_after, order;
  std::optional<double> size, gradation, markers_by_angle;
  bool no_growth = false;
  std::filesystem::path size_field;
  BoundArguments bounds;
  OrderArguments elements;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::optional<double> time_limit, memory_limit;
};

/// Takes the words of --order: at most one for the order of elements, and one for that of constraints. Throws
/// CLI::ValidationError for more.
void take_orders(MeshArguments& arguments, const std::vector<std::string>& words);

/// The library's options, except for the size field. Reads no file. Throws UsageError that says what is wrong
/// and what is right, also for options without effect.
[[nodiscard]] Options to_options(const MeshArguments& arguments);

/// The options of the repair before the mesh, if there is one, with the limits and threads of the mesh.
[[nodiscard]] std::optional<RepairOptions> repair_options(const MeshArguments& arguments,
                                                          const Options& options);

/// Reads the size field, if there is one, into the sizes. Returns its extent, unless its sizes are those of
/// the surface's vertices. Throws FileError.
std::optional<Extent> read_size_field(const MeshArguments& arguments, Options& options);

/// The stage of that name. Throws UsageError.
[[nodiscard]] Stage stage_named(const std::string& text);

/// The limit in bytes from gigabytes, without them nearly all memory of the machine (0 where no limit can be
/// kept); the limit in seconds, or 0 for none. Both throw UsageError unless the number is positive.
[[nodiscard]] std::uint64_t memory_limit_of(const std::optional<double>& gigabytes);
[[nodiscard]] double time_limit_of(const std::optional<double>& seconds);

/// The user's arguments, for the report.
[[nodiscard]] Json to_json(const MeshArguments& arguments);

}  // namespace holdfast::cli
