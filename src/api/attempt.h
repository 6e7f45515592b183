// One attempt at a mesh: all steps after the input was validated (docs/architecture.md).
#pragma once

#include <optional>
#include <vector>

#include "api/boundary.h"
#include "holdfast/holdfast.h"

namespace holdfast {

/// The result of recovery: the regions, in a mesh whose only added points are those that could not be
/// removed.
struct Recovered {
  BoxMesh box;
  Division division;
};

/// The first half: a mesh that has every facet and segment (paper §3 to §6). On entry `result` has the
/// outcome `done` and the report so far. Returns nullopt if the complex is refused.
[[nodiscard]] std::optional<Recovered> recover(const Attempt& attempt, Result& result);

/// The second half: points for the sizes, better elements (paper §6.4, §9), and the delivered mesh. Returns
/// the worst Q of the same attempt without field points, or 0 if it was not computed.
double fill(const Attempt& attempt, Recovered& recovered, Result& result);

/// Both halves.
double mesh_once(const Attempt& attempt, Result& result);

/// Sets a result with the outcome `invalid_input`, its defects and their number.
void refuse(Result& result, std::vector<Defect> defects);

}  // namespace holdfast
