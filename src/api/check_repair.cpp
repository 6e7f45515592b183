// The public functions of holdfast/check_repair.h: limits around the work of src/check_repair.
#include "holdfast/check_repair.h"

#include <new>

#include "check_repair/examine.h"
#include "mesh/plain_monitor.h"
#include "numbers/float_environment.h"

namespace holdfast {

RepairClaims claims_of(const RepairResult& result, const RepairOptions& options) {
  RepairClaims claims;
  claims.parents = result.parents;
  claims.segment_parents = result.segment_parents;
  claims.moved = result.moved;
  claims.dropped = result.dropped;
  claims.merged = result.merged;
  claims.filled = result.filled;
  claims.marker_sets = result.marker_sets;
  claims.max_displacement = result.max_displacement;
  claims.weld = options.weld;
  claims.join = options.join;
  claims.unite = options.unite;
  return claims;
}

RepairCheckResult check_repaired(const Complex& input, const Complex& output, const RepairClaims& claims,
                                 const RepairCheckOptions& options) {
  const FloatEnvironment environment;
  try {
    PlainMonitor monitor(options, options.progress);
    monitor.tell(0);
    RepairCheckResult result = checking::examine_repair(input, output, claims, options.most,
                                                        [&](double share) { monitor.poll(share); });
    monitor.tell(1);
    return result;
  } catch (const std::bad_alloc&) {
    if (options.memory_limit == 0) throw;
    throw Interrupted(Outcome::memory_limit);
  }
}

}  // namespace holdfast
