#include "mesh_attempts.h"

#include <stdexcept>
#include <utility>

#include "bound_options.h"
#include "command.h"
#include "repair_before.h"
#include "repair_result.h"
#include "unused_vertices.h"

namespace holdfast::cli {
Result mesh_or_refuse(const MeshArguments& arguments, const MeshInput& input, Options& options) {
  try {
    if (input.pasted) {
      if (arguments.drop_unused)
        throw UsageError("--drop-unused is for one file, or with --repair: the vertices of parts are kept");
      const Surface& pasted = input.pasted->surface;  // has the seeds that a single file has itself
      options.holes.insert(options.holes.end(), pasted.holes.begin(), pasted.holes.end());
      options.regions.insert(options.regions.end(), pasted.regions.begin(), pasted.regions.end());
      set_bounds(arguments.bounds, pasted.names, options);
      if (input.pasted->outcome == Outcome::done) return holdfast::mesh(*input.pasted, options);
      Result result;
      result.outcome = input.pasted->outcome;
      result.message = input.pasted->message;
      return result;
    }
    const Surface& surface = input.surface;
    options.holes.insert(options.holes.end(), surface.holes.begin(), surface.holes.end());
    options.regions.insert(options.regions.end(), surface.regions.begin(), surface.regions.end());
    set_bounds(arguments.bounds, surface.names, options);
    if (!arguments.drop_unused) return holdfast::mesh(surface.view(), options);
    const std::vector<Point> vertices = without_unused(surface);
    Complex complex = surface.view();
    complex.vertices = vertices;
    return holdfast::mesh(complex, options);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

void mesh_joined_sheets(const Surface& given, Options& options, ProgressView& progress, bool quiet,
                        MeshInput& input, RepairOptions& repairing, RepairResult& repaired, Result& result) {
  const std::size_t without_doubles = result.report.unrounded_points, added = result.report.steiner_points;
  RepairOptions watched = repairing;
  watched.progress = [&](double fraction) { return progress.repairing(fraction); };
  const bool has_mesh = mesh_joined(given.view(), options, watched, repaired, result);
  progress.finish();
  if (!has_mesh) return;
  const bool has_welded = watched.weld > repairing.weld;
  repairing.join = watched.join;
  repairing.weld = watched.weld;
  take_seeds(given, repaired.surface);
  input.surface = repaired.surface;
  if (!quiet)
    say("{} of {} added points had no doubles; repaired again, with sheets within {:.2g} of each other "
        "joined{}: {}\n",
        without_doubles, added, repairing.join, has_welded ? ", and vertices" : "", summary_of(repaired));
}

}  // namespace holdfast::cli
