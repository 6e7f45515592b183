// One attempt at a mesh: all that comes after the input was looked at (docs/architecture.md).
#pragma once

#include <cstdint>

#include "api/input.h"
#include "holdfast/holdfast.h"
#include "mesh/monitor.h"
#include "mesh/parallel.h"
#include "optimise/optimise.h"

namespace holdfast {

/// Meshes with the random orders of one seed. `result` comes with the outcome `done` and a report of what was
/// before, to which the attempt adds its own. Returns the worst Q of the same attempt without field points; 0
/// where it was not asked for. `fill_anew` tells how polyhedra round bad elements are, and is null where none
/// is.
double attempt(Input& input, const Options& options, std::uint64_t seed, const Threads& threads,
               Monitor& monitor, const FillAnew* fill_anew, Result& result);

/// For a result whose outcome is `invalid_input`: its defects, and how many.
void refuse(Result& result, std::vector<Defect> defects);

}  // namespace holdfast
