// One attempt at a mesh: all steps after the input was examined (docs/architecture.md).
#pragma once

#include <optional>
#include <vector>

#include "api/boundary.h"
#include "holdfast/holdfast.h"

namespace holdfast {

/// The result of recovery: the regions, in a mesh without added points except those that no way removes.
struct Recovered {
  BoxMesh box;
  Division division;
};

/// The first half: a mesh that has every facet and segment (paper §3 to §6). `result` comes with the outcome
/// `done` and the report so far, to which this adds its own. Nothing if the complex is refused.
[[nodiscard]] std::optional<Recovered> recover(const Attempt& attempt, Result& result);

/// The other half: points for the sizes, better elements (paper §8), and the mesh as it is delivered. Returns
/// the worst Q of the same attempt without field points; 0 where it was not asked for.
double fill(const Attempt& attempt, Recovered& recovered, Result& result);

/// Both halves.
double mesh_once(const Attempt& attempt, Result& result);

/// For a result whose outcome is `invalid_input`: its defects, and how many.
void refuse(Result& result, std::vector<Defect> defects);

}  // namespace holdfast
