#include "repair_before.h"

#include "command.h"
#include "files.h"
#include "holdfast/surface_io.h"
#include "limits.h"

namespace holdfast::cli {

RepairResult repair_before(const Surface& given, RepairOptions options, ProgressView& progress) {
  options.progress = [&](double fraction) { return progress.repairing(fraction); };
  RepairResult result = repair(given.view(), options);
  take_seeds(given, result.surface);
  progress.finish();
  return result;
}

void take_seeds(const Surface& given, Surface& repaired) {
  repaired.regions = given.regions;
  repaired.holes = given.holes;
  repaired.remarks = given.remarks;
}

int conclude_repair(const RepairResult& result) {
  if (result.outcome != Outcome::not_representable)
    return tell_limit(result.outcome, result.message + " in the repair");
  say("holdfast: {}; nothing was written; `holdfast repair --exact FILE` writes the exact arrangement, and a "
      "larger tolerance, --repair=T, may help\n",
      result.message);
  return exit_not_representable;
}

void write_repaired(const std::filesystem::path& path, const Surface& surface, Outcome outcome,
                    const WriteOptions& options, bool quiet) {
  if (path.empty() || is_interruption(outcome)) return;
  write_surface(path, surface, options);
  if (!quiet) tell(not_held(path, surface, options), path);
}

}  // namespace holdfast::cli
