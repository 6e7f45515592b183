#include "mesh_attempts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "bound_options.h"
#include "command.h"
#include "repair_before.h"
#include "repair_result.h"

namespace holdfast::cli {
namespace {

/// The tolerance that joins sheets which lie in each other but for some last bits: between such sheets points
/// that the mesher adds have no doubles.
double joining_tolerance(const Surface& surface) {
  constexpr double kLastBits = 0x1p6;  // of the largest coordinate
  double most = 0;
  for (const Point& p : surface.vertices)
    for (const double x : p)
      if (std::isfinite(x)) most = std::max(most, std::fabs(x));
  return kLastBits * (std::nextafter(most, std::numeric_limits<double>::infinity()) - most);
}

}  // namespace

Result mesh_or_refuse(const MeshArguments& arguments, const MeshInput& input, Options& options) {
  try {
    if (input.pasted) {
      const Surface& pasted = input.pasted->surface;  // seeds of a single file are its own
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
    return holdfast::mesh(surface.view(), options);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

void mesh_joined(const MeshArguments& arguments, const Surface& given, const Options& options,
                 ProgressView& progress, MeshInput& input, RepairOptions& repairing, RepairResult& repaired,
                 Result& result) {
  RepairOptions joining = repairing;
  joining.weld = joining_tolerance(given);
  RepairResult joined = repair_before(given, joining, progress);
  if (joined.outcome != Outcome::done) return;
  if (!arguments.quiet)
    say("{} of {} added points have no doubles; repaired again, with --repair={:.2g}: {}\n",
        result.report.unrounded_points, result.report.steiner_points, joining.weld, summary_of(joined));
  MeshInput other;
  other.surface = joined.surface;
  Options meshing = options;
  Result now;
  try {
    now = mesh_or_refuse(arguments, other, meshing);
  } catch (const UsageError&) {  // a size a vertex, say, of which there are fewer now
    return;
  }
  if (now.outcome != Outcome::done) return;
  input.surface = std::move(other.surface);
  repairing = joining;
  repaired = std::move(joined);
  result = std::move(now);
}

}  // namespace holdfast::cli
